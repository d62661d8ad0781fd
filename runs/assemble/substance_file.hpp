#pragma once
/// Fields of substances and signals of rules in checkpoints and in the files of a run.

#include "coupling/world/world.hpp"
#include "io/checkpoint.hpp"
#include "io/field_file.hpp"

namespace acinus::runs {

/// Writes fields and amounts, motion and adhesion that rules change, and measured signals; nothing
/// without substances and rules.
void put_substances(const coupling::State& state, io::CheckpointData& data);

/// Reads them back.
void get_substances(const io::CheckpointData& data, coupling::State& state);

/// Refuses fields that are not those of the scene's substances and grid, and signals that are not
/// those of its rules.
/// @throws Error(kFileError)
void check_substances(const coupling::Params& params, const coupling::State& state,
                      const std::string& source);

/// Fields at a time, for the files of a run.
io::FieldFrame make_field_frame(const coupling::World& world, double time);

}  // namespace acinus::runs
