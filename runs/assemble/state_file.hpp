#pragma once
/// World state to and from a checkpoint: every number bit for bit, in memory order.

#include "coupling/world/world.hpp"
#include "io/checkpoint.hpp"
#include "runs/assemble/check_state.hpp"

namespace acinus::runs {

/// Adds the state as named arrays, which refer to it. Collective if cells have holders; making the
/// parts is, too.
void put_state(const Ranks& ranks, const coupling::State& state, io::CheckpointSource& source);
/// State of one process as data.
io::CheckpointData state_data(const coupling::State& state);

/// Replaces the state of a world built from the same scene.
/// @param types  cell types of that world
/// @throws Error(kFileError) for data of another set of cells, or that no run could have written
void get_state(const io::CheckpointData& data, const StateTypes& types, coupling::State& state);

}  // namespace acinus::runs
