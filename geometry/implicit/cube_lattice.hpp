#pragma once
/// The tetrahedra that fill space, by bisection of cubes [Maubach1995].

#include <algorithm>
#include <array>
#include <vector>

#include "core/vec.hpp"
#include "geometry/implicit/shape.hpp"

namespace acinus::geometry {

/// A place of the lattice.
using Place = std::array<int, 3>;
inline constexpr int kPlaceBits = 20;  ///< of a coordinate

// Bisection goes round in three: the edge that is cut is the diagonal of a cube, then that of a
// face, then a side; then of a cube half as large. All in sides of that cube:
inline constexpr std::array<double, 3> kLongest{1.7320508075688772, 1.4142135623730951, 1};
/// How far a tetrahedron reaches from the middle of its longest edge.
inline constexpr std::array<double, 3> kExtent{0.8660254037844387, 0.7071067811865476,
                                               0.7071067811865476};
/// From one middle to that of the next bisection, summed up over all bisections to come.
inline constexpr std::array<double, 3> kToGo{2.8660254037844387, 2.3660254037844387,
                                             1.8660254037844387};
/// So near a surface, in sides of the cube at the last bisection, all must be of its size: enough
/// for those one bisection before, which reach kExtent, to be bisected wherever they meet it.
inline constexpr double kMargin = 0.6;

/// Root cubes, and how often what is in them may be bisected.
struct CubeLattice {
  Vec3 origin = Vec3::Zero();
  double root = 1;             ///< um, side of the cubes that it starts from
  int halvings = 0;            ///< of that side, until places are one apart
  double spacing = 1;          ///< um, of places
  std::vector<double> side;    ///< [level] um, of the cube that a bisection is in
  std::vector<double> ahead;   ///< [level] um, kToGo
  std::vector<int> last;       ///< [part] the level at which tetrahedra are small enough
  std::vector<int> last_fine;  ///< [fine ball]
  Place n_root{};

  int unit() const { return 1 << halvings; }
  Vec3 position(const Place& p) const { return origin + spacing * Vec3(p[0], p[1], p[2]); }
  /// How near to what asks for the level `end` the middle of a bisection of this level is
  /// necessary.
  double reach(int end, int level) const {
    if (level >= end) return -1;
    return ahead[level] - ahead[end] + kMargin * side[end];
  }
  /// The level of tetrahedra whose edges are no longer than this, um; or the last there is.
  int level_of(double size) const;
};

/// As fine as a shape asks for, and a few levels more where that leaves room for them. Throws Error
/// if there would be more than 2^20 places to a side.
CubeLattice make_lattice(const Shape& shape);

}  // namespace acinus::geometry
