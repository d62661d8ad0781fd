#pragma once
/// Contact record: place, normal and gap, written by the search, then force, slope and friction,
/// written by a law. The same for all kinds of cells and obstacles.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/pages.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

/// Kind of side b: an obstacle, a cell, or the nucleus of cell a.
enum class Partner : std::uint8_t {
  kPlane,
  kCapsule,
  kVessel,
  kMesh,
  kPipette,
  kSurface,
  kSphere,
  kNucleus
};
inline constexpr int kObstacleKinds =
    static_cast<int>(Partner::kSurface);  ///< obstacles come first
inline bool is_cell(Partner p) { return p == Partner::kSurface || p == Partner::kSphere; }

/// Point index of a side that has only one point: a sphere.
inline constexpr int kWhole = -1;

/// Contact of side a, a cell (a probing point of a deformable surface, or a sphere), with its
/// partner on side b. The force on a is +force * normal, that on b the opposite.
struct Contact {
  using Packed = std::array<float, 2>;  ///< two weights, or the bits of a double
  // Written by the search:
  int a = 0;           ///< surface or sphere
  int point = kWhole;  ///< of surface a: site * points_per_site + local index; or its triangle
  int b = 0;           ///< surface, sphere, nucleus, or number of the obstacle within its kind
  int triangle = -1;   ///< of surface, mesh or nucleus b
  Partner partner = Partner::kPlane;
  bool guard = false;  ///< the point is a node or a face centre that only pushes
  // Written by the law:
  float friction = 0;  ///< nN s/um
  // Written by the search:
  /// Barycentric weights of the first two corners of the triangle of b, as the solver stores them;
  /// gap and normal belong to the place they give (to the exact place on a mesh, which has no
  /// unknowns). Of contacts with a vessel: the bits of onset().
  Packed place{};
  /// Weights like `place` on triangle `point` of a, of contacts between triangles
  /// (dcm/contact/triangle_contact.hpp). Of other contacts the bits of stiffness() or depth().
  Packed place_a{};
  Vec3 normal = Vec3::Zero();  ///< unit, d gap / d x_a: from b towards a when apart
  double gap = 0;              ///< um, negative: overlap
  // Written by the law:
  double touching = 0;  ///< um^2 in contact
  double force = 0;     ///< nN, positive pushes apart; without friction
  double slope = 0;     ///< nN/um, its derivative by depth, not negative

  /// Depth in a vessel at which repulsion begins, um; 0 with other partners.
  double onset() const { return partner == Partner::kVessel ? std::bit_cast<double>(place) : 0; }
  /// Stiffness of points with an obstacle and of nuclei, nN/um^3.
  double stiffness() const { return std::bit_cast<double>(place_a); }
  /// Largest depth of a sphere's contacts with the points of the same surface, um.
  double depth() const { return std::bit_cast<double>(place_a); }
  static Packed pack(double x) { return std::bit_cast<Packed>(x); }

  std::array<double, 3> weights() const { return weights_at(place); }
  static std::array<double, 3> weights_at(const Packed& place) {
    const double w0 = static_cast<double>(place[0]), w1 = static_cast<double>(place[1]);
    return {w0, w1, 1 - w0 - w1};
  }
  bool is_fold() const { return partner == Partner::kSurface && a == b; }
  /// True for a contact without adhesion and friction that adds repulsion where the other contacts
  /// of its point have too little. @pre a contact of a point
  bool only_pushes() const { return guard || onset() > 0; }
};
static_assert(sizeof(Contact) == 96);  // a step reads and writes all of them: larger is slower

using Contacts = LargeVector<Contact>;

/// Kinds of contacts by their sides, in the order of the list. Spheres with spheres are not listed:
/// they are evaluated eight at a time without records (cbm::visit_pairs).
enum class ContactKind { kSurface, kObstacle, kInterface, kSphereObstacle, kNucleus };
inline constexpr std::size_t kKinds = 5;

/// Contacts of one time, one kind after the other. Contacts of one cell a are contiguous.
struct ContactList {
  Contacts all;
  std::array<std::size_t, kKinds> end{};  ///< of each kind in `all`

  /// Ends a kind at the present size of `all`; later kinds are empty.
  void close(ContactKind kind) {
    for (std::size_t k = static_cast<std::size_t>(kind); k < kKinds; ++k) end[k] = all.size();
  }
  std::size_t first(ContactKind kind) const {
    const auto k = static_cast<std::size_t>(kind);
    return k == 0 ? 0 : end[k - 1];
  }
  std::span<const Contact> of(ContactKind kind) const {
    return std::span(all).subspan(first(kind), end[static_cast<std::size_t>(kind)] - first(kind));
  }
  std::span<Contact> of(ContactKind kind) {
    return std::span(all).subspan(first(kind), end[static_cast<std::size_t>(kind)] - first(kind));
  }
  ContactKind kind_of(std::size_t contact) const {
    return static_cast<ContactKind>(std::ranges::upper_bound(end, contact) - end.begin());
  }
  std::span<const Contact> surface() const {
    return of(ContactKind::kSurface);
  }  ///< cells with each other and with static meshes
  std::span<const Contact> obstacle() const { return of(ContactKind::kObstacle); }
  std::span<const Contact> interface() const { return of(ContactKind::kInterface); }
  std::span<const Contact> sphere_obstacle() const { return of(ContactKind::kSphereObstacle); }
  std::span<const Contact> nucleus() const { return of(ContactKind::kNucleus); }
};

}  // namespace acinus::contact
