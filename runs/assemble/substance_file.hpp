#pragma once
/// Fields of substances in checkpoints and in the files of a run.

#include "coupling/world/world.hpp"
#include "io/checkpoint.hpp"
#include "io/field_file.hpp"

namespace acinus::runs {

/// Writes fields, amounts and guidance; nothing without substances.
void put_substances(const coupling::State& state, io::CheckpointData& data);

/// Reads them back.
void get_substances(const io::CheckpointData& data, coupling::State& state);

/// Refuses fields that are not those of the scene's substances and grid.
/// @throws Error(kFileError)
void check_substances(const coupling::SubstanceParams& params, const coupling::State& state,
                      const std::string& source);

/// Fields at a time, for the files of a run.
io::FieldFrame make_field_frame(const coupling::World& world, double time);

}  // namespace acinus::runs
