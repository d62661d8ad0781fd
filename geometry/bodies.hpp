#pragma once
/// Bodies of a file of triangles: what hangs together at edges, not at corners.

#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// The triangles of a file and the solid, object or group that the file puts each in.
struct Soup {
  Surface surface;
  std::vector<int> group;  ///< [triangle]; empty: the file names none
};

/// Closed surfaces first within each group; those left open are joined by the place of their
/// corners, across groups, and split again. Where more than two triangles meet at an edge, those
/// are taken together that bound the same solid, so that bodies that share a wall, an edge or a
/// corner come apart. Ordered by the first triangle; nodes keep their order, unused ones are left
/// out.
std::vector<Surface> split_bodies(const Soup& soup);

/// A body that lies inside another, and that other.
struct Nested {
  int inner = -1, outer = -1;  ///< -1: there is none
};

/// @param bodies  closed. Cost: linear in bodies times those whose boxes hold them
Nested find_nested(const std::vector<Surface>& bodies);

}  // namespace acinus::geometry
