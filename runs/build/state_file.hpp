#pragma once
/// World state to and from a checkpoint: every number, bit for bit, in memory order.

#include "core/io/checkpoint.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

void put_state(const coupling::State& state, io::CheckpointData& data);

/// Replaces the state of a world built from the same scene.
/// @throws Error when the data does not fit the world (another set of cells)
void get_state(const io::CheckpointData& data, coupling::State& state);

}  // namespace acinus::runs
