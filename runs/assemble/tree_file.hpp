#pragma once
/// Flexible vessels in a checkpoint.

#include "coupling/vessels/vessel_tree.hpp"
#include "io/checkpoint.hpp"

namespace acinus::runs {

/// Places and rotations (w, x, y, z) of the nodes; nothing where there are none.
void put_tree(const coupling::TreeState& tree, io::CheckpointData& data);

/// Of a tree with as many nodes; nothing where it has none.
/// @throws Error where the file has others
void get_tree(const io::CheckpointData& data, coupling::TreeState& tree);

}  // namespace acinus::runs
