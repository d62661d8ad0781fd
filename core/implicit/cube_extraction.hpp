#pragma once
/// The surface within one root cube of the lattice.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/implicit/cube_lattice.hpp"
#include "core/implicit/extract.hpp"
#include "core/vec.hpp"

namespace acinus::implicit {

/// What matters in and near a root cube, ascending.
struct Nearby {
  std::vector<int> part, fine;
};

/// What one root cube contributes: nodes on edges, some of which other cubes have as well.
struct CubePart {
  std::vector<std::uint64_t> key;  ///< [node] the same in all cubes
  std::vector<Vec3> node;
  std::vector<std::array<Vec3, 2>> edge;  ///< ZeroSurface
  std::vector<std::array<int, 3>> triangle;
  int coarsest =
      std::numeric_limits<int>::max();  ///< level of the tetrahedra that are not bisected
  /// Middles of edges along which the function has another sign than at both ends, to become
  /// corners.
  std::vector<FineBall> missed;
};

/// um, 0 within.
double find_distance(const FineBall& ball, const Vec3& x);

/// @param fine  Shape::fine, and what has been added to it
/// @param find_missed  CubePart::missed is wanted
CubePart extract_cube(const Shape& shape, std::span<const FineBall> fine,
                      const CubeLattice& lattice, const Place& cube, Nearby nearby,
                      bool find_missed);

}  // namespace acinus::implicit
