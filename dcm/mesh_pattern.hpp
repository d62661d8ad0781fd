#pragma once
/// Which pairs of nodes of one cell mesh interact, and where each edge, hinge and triangle finds
/// its block. One per topology, made once.

#include <array>
#include <vector>

#include "core/mesh/topology.hpp"
#include "core/solve/system.hpp"

namespace acinus::dcm {

/// A pair block and whether the caller's (a, b) is stored as (b, a).
struct PairSlot {
  int pair = 0;
  bool flipped = false;
};

struct MeshPattern {
  solve::BlockPattern blocks;  ///< the first n_edge pairs are the edges, then the across-edge pairs
  /// [n_edge] pairs (1,2) (1,3) (1,4) (2,3) (2,4) (3,4) of the hinge's nodes
  std::vector<std::array<PairSlot, 6>> hinge_pair;
  std::vector<std::array<PairSlot, 3>> triangle_pair;  ///< [n_triangle] pairs (0,1) (1,2) (2,0)
};

/// The node pairs of a hinge, in the order of MeshPattern::hinge_pair.
inline constexpr std::array<std::array<int, 2>, 6> kHingePairs{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

MeshPattern make_mesh_pattern(const mesh::Topology& topology);

/// Kept for the life of the program, keyed by the address of the topology.
const MeshPattern& shared_mesh_pattern(const mesh::Topology& topology);

}  // namespace acinus::dcm
