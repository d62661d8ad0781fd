#pragma once
/// Tetrahedra that fill space, by bisection of cubes [Maubach1995].

#include <algorithm>
#include <array>
#include <vector>

#include "core/vec.hpp"
#include "geometry/implicit/shape.hpp"

namespace acinus::geometry {

/// Integer coordinates of a lattice point.
using Place = std::array<int, 3>;
inline constexpr int kPlaceBits = 20;  ///< bits of a coordinate

// Bisection goes round in three: the edge that is cut is the diagonal of a cube, then that of a
// face, then a side; then of a cube half as large. All in sides of that cube:
inline constexpr std::array<double, 3> kLongest{1.7320508075688772, 1.4142135623730951, 1};
/// Largest distance of a tetrahedron's points from the midpoint of its longest edge.
inline constexpr std::array<double, 3> kExtent{0.8660254037844387, 0.7071067811865476,
                                               0.7071067811865476};
/// Bound of the distance from the midpoint of the longest edge to the midpoints of all further
/// bisections: the sum of the distances from one bisection to the next.
inline constexpr std::array<double, 3> kRemaining{2.8660254037844387, 2.3660254037844387,
                                                  1.8660254037844387};
/// Distance to a surface within which all tetrahedra must have its size, in sides of the cube at
/// the last bisection: enough for those one bisection before, which extend by kExtent, to be
/// bisected wherever they meet it.
inline constexpr double kMargin = 0.6;

/// Root cubes, and the number of bisections within them.
struct CubeLattice {
  Vec3 origin = Vec3::Zero();
  double root = 1;                ///< um, side of the root cubes
  int halvings = 0;               ///< of that side, down to the distance of neighbouring places
  double spacing = 1;             ///< um, distance of neighbouring places
  std::vector<double> side;       ///< [level] um, of the cube that a bisection is in
  std::vector<double> remaining;  ///< [level] um, as kRemaining
  std::vector<int> last;          ///< [part] level at which tetrahedra are small enough
  std::vector<int> last_fine;     ///< [fine ball] likewise
  Place n_root{};

  int unit() const { return 1 << halvings; }
  Vec3 position(const Place& p) const { return origin + spacing * Vec3(p[0], p[1], p[2]); }
  /// Largest distance, um, from a part that needs the level `end` to the midpoint of a bisection of
  /// this level that it makes necessary. -1: none.
  double reach(int end, int level) const {
    if (level >= end) return -1;
    return remaining[level] - remaining[end] + kMargin * side[end];
  }
  /// Level of tetrahedra whose edges are no longer than this, um; at most the last level.
  int level_of(double size) const;
};

/// Lattice as fine as a shape needs, and a few levels more where the coordinates have bits for
/// them. Throws Error if there would be more than 2^20 places to a side.
CubeLattice make_lattice(const Shape& shape);

}  // namespace acinus::geometry
