#pragma once
/// Surface within one root cube of the lattice.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/implicit/cube_lattice.hpp"
#include "geometry/implicit/shape.hpp"

namespace acinus::geometry {

/// Parts and fine balls in and near a root cube, ascending.
struct Nearby {
  std::vector<int> part, fine;
};

/// Edge along which the function has another sign than at both ends.
struct MissedEdge {
  FineBall middle;      ///< ball that makes the midpoint a corner
  bool is_gap = false;  ///< both ends are inside
};

/// Contribution of one root cube: nodes on edges, some of which other cubes have as well.
struct CubePart {
  std::vector<std::uint64_t> key;  ///< [node] edge key, the same in all cubes
  std::vector<Vec3> node;
  std::vector<std::array<Vec3, 2>> edge;  ///< [node] um, as ZeroSurface::edge
  std::vector<std::array<int, 3>> triangle;
  int coarsest =
      std::numeric_limits<int>::max();  ///< level of the tetrahedra that are not bisected
  std::vector<MissedEdge> missed;
};

/// True if a place is at most `reach` from a ball, um; false if reach is below 0.
bool is_within(const FineBall& ball, const Vec3& x, double reach);

/// True if other root cubes may have the node of a key as well.
bool is_on_face(std::uint64_t key, const CubeLattice& lattice);

/// Surface of a function within one root cube.
/// @param fine  Shape::fine, and the balls added to it
/// @param find_missed  CubePart::missed is wanted
CubePart extract_cube(const Shape& shape, std::span<const FineBall> fine,
                      const CubeLattice& lattice, const Place& cube, Nearby nearby,
                      bool find_missed);

}  // namespace acinus::geometry
