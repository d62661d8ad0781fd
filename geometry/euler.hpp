#pragma once
/// Topological invariants of a surface: its parts and handles.

#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

struct Connectivity {
  int parts = 0;          ///< connected components
  long euler_number = 0;  ///< nodes - edges + triangles: 2 a part, less 2 for every handle

  long handles() const { return parts - euler_number / 2; }
  bool operator==(const Connectivity&) const = default;
};

/// Connectivity of a closed surface; nodes of no triangle do not count.
Connectivity compute_connectivity(const Surface& surface);

/// Connectivity of the wall of a network whose segments meet only where they share a node: a handle
/// for every loop.
Connectivity compute_connectivity(const Network& network);

}  // namespace acinus::geometry
