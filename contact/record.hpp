#pragma once
/// What is known about a contact, whatever meets: one record, written in two goes. The search fills
/// in where and how near; a law then says how hard, how stiff and how rough.

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::contact {

/// What stands on side b: a kind of obstacle, or of cell.
enum class Partner : std::uint8_t { kPlane, kCapsule, kVessel, kMesh, kPipette, kSurface, kSphere };
inline constexpr int kObstacleKinds = static_cast<int>(Partner::kSurface);  ///< they come first
inline bool is_cell(Partner p) { return p == Partner::kSurface || p == Partner::kSphere; }

/// The point of a side that has only one: a sphere.
inline constexpr int kWhole = -1;

/// Side a is a cell: a probing point of a deformable surface, or a sphere. Its force is
/// +force * normal, that on b the opposite.
struct Contact {
  // Written by the search:
  int a = 0;           ///< surface or sphere
  int point = kWhole;  ///< of surface a: site * points_per_site + local index
  int b = 0;           ///< surface, sphere, or number of the obstacle within its kind
  int triangle = -1;   ///< of surface or mesh b
  Partner partner = Partner::kPlane;
  bool guard = false;  ///< the point is a node or a face centre that only pushes
  // Written by the law, here for lack of room below:
  float friction = 0;  ///< nN s/um
  // Written by the search:
  union {
    /// Surface and mesh: barycentric weights of the first two corners of the triangle, as the
    /// solver keeps them; gap and normal are those of the place they name (of the exact place on a
    /// mesh, which has no unknowns).
    std::array<float, 2> place{};
    double stiffness;  ///< other obstacles of a surface: nN/um^3 under compression
    double depth;      ///< sphere at a surface: um, the deepest point of this pair of cells
  };
  Vec3 normal = Vec3::Zero();  ///< unit, d gap / d x_a: from b towards a when apart
  double gap = 0;              ///< um, negative: overlap
  /// um, how deep inside an obstacle it begins to push; of two triangles the place on a (place_a)
  double onset = 0;
  // Written by the law:
  double touching = 0;  ///< um^2 in touch
  double force = 0;     ///< nN, positive pushes apart; without friction
  double slope = 0;     ///< nN/um, its growth with depth, not negative

  std::array<double, 3> weights() const { return weights_at(place); }
  static std::array<double, 3> weights_at(const std::array<float, 2>& place) {
    const double w0 = static_cast<double>(place[0]), w1 = static_cast<double>(place[1]);
    return {w0, w1, 1 - w0 - w1};
  }
  /// Two triangles (dcm/contact/triangle_contact.hpp): weights of the first two corners of triangle
  /// `point` of surface a, as `place` has those of b. They stand in `onset`, for lack of room.
  std::array<float, 2> place_a() const { return std::bit_cast<std::array<float, 2>>(onset); }
  void set_place_a(const std::array<float, 2>& weight) { onset = std::bit_cast<double>(weight); }
  bool is_fold() const { return partner == Partner::kSurface && a == b; }
  /// A second contact of a point, to push with what the others do not.
  bool only_pushes() const { return guard || onset > 0; }
};
static_assert(sizeof(Contact) == 96);  // a step reads and writes all of them: larger is slower

/// All contacts of a moment, in four ranges one after the other. In each of them contacts of one
/// cell a stand together.
struct ContactList {
  std::vector<Contact> all;
  /// Where ranges end: surfaces with surfaces and static meshes; surfaces with other obstacles;
  /// surfaces with spheres; spheres with obstacles. What follows are spheres with spheres, listed
  /// for those that look: a step works them out eight at a time without records.
  std::size_t surface_end = 0, obstacle_end = 0, interface_end = 0, sphere_obstacle_end = 0;

  std::span<const Contact> surface() const { return range(0, surface_end); }
  std::span<const Contact> obstacle() const { return range(surface_end, obstacle_end); }
  std::span<const Contact> interface() const { return range(obstacle_end, interface_end); }
  std::span<const Contact> sphere_obstacle() const {
    return range(interface_end, sphere_obstacle_end);
  }
  std::span<const Contact> sphere() const { return range(sphere_obstacle_end, all.size()); }
  std::span<const Contact> range(std::size_t first, std::size_t last) const {
    return std::span(all).subspan(first, last - first);
  }
};

}  // namespace acinus::contact
