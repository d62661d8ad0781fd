#pragma once
/// Bodies of a file of triangles: parts connected by edges, not by corners.

#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Triangles of a file, each with its solid, object or group in that file.
struct Soup {
  Surface surface;
  std::vector<int> group;  ///< [triangle]; empty: the file has no groups
};

/// Splits triangles into bodies. Closed surfaces come first within each group; open ones are joined
/// at nodes with equal positions, across groups, and split again. Where more than two triangles
/// meet at an edge, those that bound the same solid are paired, so that bodies sharing a wall, an
/// edge or a corner are separated. Ordered by the first triangle; nodes keep their order, unused
/// ones are left out.
std::vector<Surface> split_bodies(const Soup& soup);

/// Body that lies inside another, and that other.
struct Nested {
  int inner = -1, outer = -1;  ///< -1: there is none
};

/// First nested pair among closed bodies. Cost: linear in bodies times those whose boxes contain
/// them
Nested find_nested(const std::vector<Surface>& bodies);

}  // namespace acinus::geometry
