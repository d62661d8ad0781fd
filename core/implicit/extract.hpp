#pragma once
/// The surface on which a function of space is zero, as triangles as small as each part of it asks
/// for.

#include <functional>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/mesh/surface.hpp"
#include "core/vec.hpp"

namespace acinus::implicit {

/// A function, negative inside, put together from parts each of which matters near itself only.
/// Parts are given in ascending order; those left out are farther than `reach` from the place.
struct Shape {
  /// um. @param parts  those that may matter
  std::function<double(const Vec3&, std::span<const int> parts)> value;
  /// um, of one part alone: never changes by more than the place moves.
  std::function<double(const Vec3&, int part)> distance;
  std::vector<double> size;  ///< [part] um, longest edge of the tetrahedra that cut it
  std::vector<Box> box;      ///< [part] that holds its surface
  double reach = 0;          ///< um, how far from its own surface a part may change that of others
};

/// Closed surface between places of a lattice where the function is negative and those where it is
/// not: space is filled with tetrahedra, which are bisected [Maubach1995] down to the size that the
/// parts near them ask for, and each is cut by a plane piece. Whether one is bisected follows from
/// the middle of its longest edge alone, so that all around an edge agree and no cracks open. So
/// the surface is a manifold without self-intersection, whatever the function is; its nodes stand
/// where the function is zero. Two surfaces nearer to each other than the tetrahedra can be joined.
/// The same for any number of threads. Cost: linear in triangles.
/// Throws Error if the sizes differ so much, or the extent is so large, that there would be more
/// than 2^20 places to a side, or more than `most` triangles.
mesh::Surface extract_zero(const Shape& shape, std::size_t most);

}  // namespace acinus::implicit
