#pragma once
/// The surface on which a function of space is zero, as triangles as small as each part of it asks
/// for.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Longest edge of the tetrahedra over the mean edge of the triangles that they are cut in.
inline constexpr double kTetrahedra = 4;

/// A place where triangles must be smaller than its parts ask for.
struct FineBall {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
  double size = 0;             ///< um, as Shape::size
};

/// A function, negative inside, put together from parts each of which matters near itself only.
/// Parts are given in ascending order; those left out are farther than their `reach` from the
/// place.
struct Shape {
  /// um. @param parts  those that may matter
  std::function<double(const Vec3&, std::span<const int> parts)> value;
  /// um, of one part alone: never changes by more than the place moves.
  std::function<double(const Vec3&, int part)> distance;
  std::vector<double> size;  ///< [part] um, longest edge of the tetrahedra that cut it
  std::vector<Box> box;      ///< [part] that holds its surface
  /// [part] um, how far from its own surface a part may change that of others.
  std::vector<double> reach;
  std::vector<FineBall> fine;
};

/// So near the ends of an edge, as a share of it, no node stands: triangles would have no area.
inline constexpr double kEdgeEnd = 0.02;

/// Where a function is zero.
struct ZeroSurface {
  geometry::Surface surface;
  /// [node] um, the edge of a tetrahedron that it stands on. Wherever all of them stand between the
  /// ends of theirs, the surface is a manifold that does not cross itself.
  std::vector<std::array<Vec3, 2>> edge;
};

/// Leaves out of a surface what is not wanted, and counts parts and loops of the rest that ought
/// not to be, or are missing.
using CountFaults = std::function<long(ZeroSurface&)>;

/// Closed surface between places of a lattice where the function is negative and those where it is
/// not: space is filled with tetrahedra, which are bisected [Maubach1995] down to the size that the
/// parts and fine balls near them ask for, and each is cut by a plane piece. Whether one is
/// bisected follows from the middle of its longest edge alone, so that all around an edge agree and
/// no cracks open. So the surface is a manifold without self-intersection, whatever the function
/// is; its nodes stand where the function is zero. Two surfaces nearer to each other than the
/// tetrahedra can be joined: as long as the surface has faults, edges are looked for along
/// which the function has another sign than at both ends, and these are bisected as well. The same
/// for any number of threads. Cost: linear in triangles. Throws Error if the sizes differ so much,
/// or the extent is so large, that there would be more than 2^20 places to a side, or more than
/// `most` triangles.
/// @param count_faults  null: there are none; where they remain, the surface with the fewest comes
/// back
ZeroSurface extract_zero(const Shape& shape, std::size_t most,
                         const CountFaults& count_faults = {});

}  // namespace acinus::geometry
