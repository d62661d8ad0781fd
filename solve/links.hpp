#pragma once
/// Contacts as the solver sees them: stencils of points that pull on each other along a normal.
///
/// A side of a contact is a place on one cell, x = w0 x0 + w1 x1 + (1 - w0 - w1) x2. The third
/// weight is never stored: both sides then get exactly the same force, whatever the weights were
/// rounded to. The relative vector is r = x_a - x_b; side b has no unknowns when it is
/// boundary.

#include <array>
#include <cstdint>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/parallel/make_room.hpp"
#include "core/vec.hpp"

namespace acinus::solve {

/// Number of a point: row * kLanes + lane.
using Point = std::uint32_t;
inline constexpr Point kNowhere = 0xffffffff;  ///< the point of a side without unknowns

inline Address address_of(Point p) { return p / kLanes * kPointStride + p % kLanes; }
inline Point point_at(Address a) { return a / kPointStride * kLanes + a % kPointStride; }

/// One place on a cell.
struct Side {
  std::array<Point, 3> point{kNowhere, kNowhere, kNowhere};
  std::array<float, 2> weight{};  ///< of the first two points

  static Side at(Point p) { return {{p, p, p}, {0, 0}}; }
  static Side nowhere() { return {}; }
  bool exists() const { return point[0] != kNowhere; }
  /// A point, not a place between three: the weights do not count.
  ACINUS_INLINE bool is_single() const { return point[0] == point[2]; }
};

/// What the matrix needs of a contact: one cache line. Matrix of r: friction_scale friction I +
/// stiffness_scale stiffness n n^T.
struct Link {
  Side a, b;
  std::array<float, 3> normal{};  ///< unit, direction in which r opens the gap
  float stiffness = 0;            ///< nN/um, not negative
  float friction = 0;             ///< nN s/um, not negative
  float gap = 0;                  ///< um, for judging a step; +infinity where depth does not matter
};
static_assert(sizeof(Link) == 64);

/// Writes the coefficients of a link, rounded to what it keeps.
inline void set_law(double stiffness, double friction, double gap, const Vec3& normal, Link& link) {
  for (int k = 0; k < 3; ++k) link.normal[k] = static_cast<float>(normal[k]);
  link.stiffness = static_cast<float>(stiffness);
  link.friction = static_cast<float>(friction);
  link.gap = static_cast<float>(gap);
}

/// Force on side a: force * normal.
struct LinkLoad {
  Vec3 normal = Vec3::Zero();
  double force = 0;  ///< nN, positive pushes apart
  /// Law once the gap is closed, force = -closed_stiffness * gap; nN/um. 0: none to switch to.
  double closed_stiffness = 0;
  double clearance = 0;  ///< um, distance of the contact from that branch; not positive: is on it
  std::uint32_t contact = 0;  ///< its index in the list of contacts
};

/// Contacts with up to three points a side, sorted by the cell of side a.
struct Links {
  std::vector<Link> link;
  std::vector<LinkLoad> load;  ///< of the same contact
  /// [n_link] 1: has its closed law although it was open; see coupling/step/active_set.hpp. Empty:
  /// none.
  std::vector<std::uint8_t> closed;

  std::size_t size() const { return link.size(); }
  void resize(std::size_t n) {
    set_size(link, n);
    set_size(load, n);
    closed.clear();
  }
  bool is_closed(std::size_t l) const { return !closed.empty() && closed[l] != 0; }
  void clear() { resize(0); }
};

/// A contact of one point with one other, or with boundary (b = kNowhere). Its force is not
/// kept here: the owner adds it in double along the exact direction.
struct PointLink {
  Point a = 0, b = kNowhere;
  std::array<float, 3> normal{};
  float stiffness = 0, friction = 0;
};

/// All points and weights of a link, side b negative: r = sum weight x, and the force on a point is
/// weight times the force on side a.
struct Stencil {
  int n = 0;
  std::array<Address, 6> address{};
  std::array<double, 6> weight{};
};
Stencil stencil_of(const Link& link);

}  // namespace acinus::solve
