#pragma once
/// The surface within one root cube of the lattice.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/implicit/cube_lattice.hpp"
#include "geometry/implicit/shape.hpp"

namespace acinus::geometry {

/// What matters in and near a root cube, ascending.
struct Nearby {
  std::vector<int> part, fine;
};

/// An edge along which the function has another sign than at both ends.
struct MissedEdge {
  FineBall middle;      ///< that makes it a corner
  bool is_gap = false;  ///< both ends are inside
};

/// What one root cube contributes: nodes on edges, some of which other cubes have as well.
struct CubePart {
  std::vector<std::uint64_t> key;  ///< [node] the same in all cubes
  std::vector<Vec3> node;
  std::vector<std::array<Vec3, 2>> edge;  ///< ZeroSurface
  std::vector<std::array<int, 3>> triangle;
  int coarsest =
      std::numeric_limits<int>::max();  ///< level of the tetrahedra that are not bisected
  std::vector<MissedEdge> missed;
};

/// Whether a place is no farther from a ball than that, um; below 0: none is.
bool is_within(const FineBall& ball, const Vec3& x, double reach);

/// Whether other root cubes may have the node of a key as well.
bool is_on_face(std::uint64_t key, const CubeLattice& lattice);

/// @param fine  Shape::fine, and what has been added to it
/// @param find_missed  CubePart::missed is wanted
CubePart extract_cube(const Shape& shape, std::span<const FineBall> fine,
                      const CubeLattice& lattice, const Place& cube, Nearby nearby,
                      bool find_missed);

}  // namespace acinus::geometry
