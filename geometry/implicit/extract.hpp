#pragma once
/// Zero surface of a function of space, as triangles of the size that each part of it needs.

#include <cstddef>
#include <functional>

#include "geometry/implicit/shape.hpp"
#include "geometry/implicit/zero_surface.hpp"

namespace acinus::geometry {

/// Longest edge of the tetrahedra over the mean edge of the triangles cut from them.
inline constexpr double kTetrahedra = 4;

/// Function that removes unwanted parts of a surface and counts the faults of the rest: parts and
/// loops in excess or missing.
using CountFaults = std::function<long(ZeroSurface&)>;

/// Closed surface between lattice places where the function is negative and those where it is not.
/// Space is filled with tetrahedra, which are bisected [Maubach1995] down to the size that the
/// parts and fine balls near them need, and each is cut by a plane piece. The midpoint of its
/// longest edge alone decides on the bisection of a tetrahedron, so that all round an edge agree
/// and no cracks open. So the surface is a manifold without self-intersection for any function; its
/// nodes are where the function is zero. Two surfaces nearer to each other than the tetrahedra can
/// be joined: as long as the surface has faults, edges along which the function has another sign
/// than at both ends are searched for and bisected as well. The same for any number of threads.
/// Cost: linear in triangles. Throws Error if the sizes differ so much, or the extent is so large,
/// that there would be more than 2^20 places to a side, or more than `most` triangles.
/// @param count_faults  null: there are none; where faults remain, the surface with the fewest is
///                      returned
ZeroSurface extract_zero(const Shape& shape, std::size_t most,
                         const CountFaults& count_faults = {});

}  // namespace acinus::geometry
