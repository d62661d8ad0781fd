#pragma once
/// State of flexible vessels in a checkpoint.

#include "coupling/vessels/vessel_tree.hpp"
#include "io/checkpoint.hpp"

namespace acinus::runs {

/// Writes positions (um) and rotations (quaternion w, x, y, z) of the nodes; nothing for a tree
/// without nodes.
void put_tree(const coupling::TreeState& tree, io::CheckpointData& data);

/// Reads positions and rotations into a tree of the same size; nothing for a tree without nodes.
/// @throws Error if the file holds another number of nodes
void get_tree(const io::CheckpointData& data, coupling::TreeState& tree);

}  // namespace acinus::runs
