#pragma once
/// Triangles where a function is zero, with the edges that their nodes stand on.

#include <array>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Share of an edge at its ends where no node stands: triangles would have no area.
inline constexpr double kEdgeEnd = 0.02;

/// Surface where a function is zero.
struct ZeroSurface {
  Surface surface;
  /// [node] um, the edge of a tetrahedron that it stands on. Wherever all of them stand between the
  /// ends of theirs, the surface is a manifold that does not cross itself.
  std::vector<std::array<Vec3, 2>> edge;
};

}  // namespace acinus::geometry
