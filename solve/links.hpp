#pragma once
/// Contacts of the linear system: stencils of points with a force along a normal.
///
/// A side of a contact is a point on one cell, x = w0 x0 + w1 x1 + (1 - w0 - w1) x2. The third
/// weight is never stored: both sides then get exactly the same force, whatever the rounding of the
/// weights. The relative vector is r = x_a - x_b; side b has no unknowns when it is boundary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/pages.hpp"
#include "core/vec.hpp"

namespace acinus::solve {

/// Index of a point: row * kLanes + lane.
using Point = std::uint32_t;
inline constexpr Point kNowhere = 0xffffffff;  ///< point of a side without unknowns

inline Address address_of(Point p) { return p / kLanes * kPointStride + p % kLanes; }
inline Point point_at(Address a) { return a / kPointStride * kLanes + a % kPointStride; }

/// Side of a contact: a point on one cell.
struct Side {
  std::array<Point, 3> point{kNowhere, kNowhere, kNowhere};
  std::array<float, 2> weight{};  ///< of the first two points

  static Side at(Point p) { return {{p, p, p}, {0, 0}}; }
  static Side nowhere() { return {}; }
  bool exists() const { return point[0] != kNowhere; }
  /// True for a single point, not one between three; its weights are 0.
  ACINUS_INLINE bool is_single() const { return point[0] == point[2]; }
  /// True for a place between the first two points. A single point does not count.
  bool is_on_edge() const { return weight[0] + weight[1] == 1; }
};

/// Matrix of a contact, in one cache line. Matrix of r: friction_scale friction I + stiffness_scale
/// stiffness n n^T.
struct Link {
  Side a, b;
  std::array<float, 3> normal{};  ///< unit, direction in which r opens the gap
  float stiffness = 0;            ///< nN/um, not negative
  float friction = 0;             ///< nN s/um, not negative
  float gap = 0;                  ///< um, for step control; +infinity where depth does not matter
};
static_assert(sizeof(Link) == 64);

/// Sets the coefficients of a link, rounded to its precision.
inline void set_law(double stiffness, double friction, double gap, const Vec3& normal, Link& link) {
  for (int k = 0; k < 3; ++k) link.normal[k] = static_cast<float>(normal[k]);
  link.stiffness = static_cast<float>(stiffness);
  link.friction = static_cast<float>(friction);
  link.gap = static_cast<float>(gap);
}

/// Law of the closed gap of a contact, force = -stiffness * clearance.
struct ClosedLaw {
  double stiffness = 0;  ///< nN/um; 0: no such law
  double clearance = 0;  ///< um, distance to this branch; not positive: the contact is on it
};

/// Origin of a link: the contact that has its force and exact normal, and its law when closed,
/// rounded to the precision of links.
struct LinkLaw {
  float stiffness = 0, clearance = 0;  ///< of closed()
  std::uint32_t contact = 0;           ///< its index in the list of contacts

  ClosedLaw closed() const {
    return {static_cast<double>(stiffness), static_cast<double>(clearance)};
  }
  void close(const ClosedLaw& law) {
    stiffness = static_cast<float>(law.stiffness);
    clearance = static_cast<float>(law.clearance);
  }
};

/// Force of a link on its side a, nN, by the index of the link.
using LinkForce = std::function<Vec3(std::size_t)>;

/// Contacts with up to three points a side, sorted by the cell of side a. New ones have no values.
struct Links {
  LargeVector<Link> link;
  LargeVector<LinkLaw> law;  ///< [n_link]
  /// [n_link] 1: takes its closed law although it was open, 2: did and opens again; see
  /// coupling/step/active_set.hpp. Empty: none.
  std::vector<std::uint8_t> closed;

  std::size_t size() const { return link.size(); }
  void resize(std::size_t n) {
    set_size(link, n);
    set_size(law, n);
    closed.clear();
  }
  bool is_closed(std::size_t l) const { return !closed.empty() && closed[l] == 1; }
  void clear() { resize(0); }
};

/// Contact of one point with one other, or with boundary (b = kNowhere). Its force is not kept
/// here: the owner adds it in double along the exact direction.
struct PointLink {
  Point a = 0, b = kNowhere;
  std::array<float, 3> normal{};
  float stiffness = 0, friction = 0;
};
using PointLinks = LargeVector<PointLink>;

/// Unit normal of a contact, in double.
template <class L>
Vec3 normal_of(const L& link) {
  return {static_cast<double>(link.normal[0]), static_cast<double>(link.normal[1]),
          static_cast<double>(link.normal[2])};
}

/// Points and weights of a link, side b negative: r = sum weight x, and the force on a point is
/// weight times the force on side a.
struct Stencil {
  int n = 0;
  std::array<Address, 6> address{};
  std::array<double, 6> weight{};
};
Stencil stencil_of(const Link& link);

}  // namespace acinus::solve
