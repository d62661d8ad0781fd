#pragma once
/// The surface on which a function of space is zero, as triangles as small as each part of it asks
/// for.

#include <cstddef>
#include <functional>

#include "geometry/implicit/shape.hpp"
#include "geometry/implicit/zero_surface.hpp"

namespace acinus::geometry {

/// Longest edge of the tetrahedra over the mean edge of the triangles that they are cut in.
inline constexpr double kTetrahedra = 4;

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
