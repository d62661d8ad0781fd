#pragma once
/// Zero surface of a function: triangles with the edges that their nodes lie on.

#include <array>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Share of an edge at its ends without nodes: triangles there would have no area.
inline constexpr double kEdgeEnd = 0.02;

/// Zero surface of a function.
struct ZeroSurface {
  Surface surface;
  /// [node] um, edge of a tetrahedron that the node lies on. As long as all nodes are between the
  /// ends of their edges, the surface is a manifold that does not cross itself.
  std::vector<std::array<Vec3, 2>> edge;
};

}  // namespace acinus::geometry
