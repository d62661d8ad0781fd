#pragma once
/// What stands around the cells and has no unknowns of its own, by name: planes, a capsule,
/// pipettes, vessels, static meshes.

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contact/gap.hpp"
#include "contact/material.hpp"
#include "contact/record.hpp"
#include "contact/static_mesh.hpp"
#include "contact/wall_mesh.hpp"
#include "core/vec.hpp"
#include "geometry/network.hpp"

namespace acinus::contact {

// Walls: obstacles given by a formula, that have a name and may move and vanish. A kind of wall is
// a struct with name, material and opens, a Partner, its line in for_each_wall and one of each of
// the functions below; all that meets walls goes through these.

/// Cells stay where (x - point).normal >= 0. It may move along its normal and, in the end, vanish.
struct Plane {
  std::string name;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  double speed = 0;   ///< um/s along the normal
  double travel = 0;  ///< um, where the motion stops
  Material material;
  double opens = std::numeric_limits<double>::infinity();  ///< s, after that it is gone
  Vec3 point_at(double time) const;  ///< out of any cell's reach once it is gone
};

/// A rigid sphere seen from inside, which may shrink and, in the end, vanish.
struct Capsule {
  std::string name;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double speed = 0;  ///< um/s, shrink rate
  double min_radius = 0;
  double opens = std::numeric_limits<double>::infinity();  ///< s, after that it is gone
  Material material;
  double radius_at(double time) const;  ///< infinite once it is open
};

/// A rigid tube with a rounded rim at both ends; cells meet its inside, its outside and its rims.
/// Cut along the axis its wall is a rectangle with round corners.
struct Pipette {
  std::string name;
  Vec3 mouth = Vec3::Zero();  ///< centre of the plane in which the tube begins
  Vec3 axis = Vec3::UnitZ();  ///< unit, from the mouth into the tube
  double radius = 0;          ///< um, inner
  double thickness = 0;       ///< um, of the wall
  double lip = 0;             ///< um, radius of the rims; at most half the thickness and the length
  double length = 0;          ///< um, along the axis
  double opens = std::numeric_limits<double>::infinity();  ///< s, after that it is gone
  Material material;
};

struct Vessels {
  geometry::Network network;
  /// Surface that cells touch in place of the cones of the network; null: the cones.
  std::shared_ptr<const WallMesh> wall;
  Material material;
  std::vector<std::vector<int>> segments_of_node;  ///< for finding chains
};

struct Boundary {
  std::vector<Plane> planes;
  std::vector<Capsule> capsules;
  std::vector<Pipette> pipettes;
  Vessels vessels;
  std::vector<StaticMesh> meshes;
  bool empty() const;
};

/// Calls visit(partner, index, wall) for every wall, kind by kind.
template <class AnyBoundary, class Visit>
void for_each_wall(AnyBoundary& boundary, Visit visit) {
  const auto each = [&](Partner kind, auto& walls) {
    for (std::size_t i = 0; i < walls.size(); ++i) visit(kind, static_cast<int>(i), walls[i]);
  };
  each(Partner::kPlane, boundary.planes);
  each(Partner::kCapsule, boundary.capsules);
  each(Partner::kPipette, boundary.pipettes);
}

const Material& material_of(const Boundary& boundary, Partner obstacle, int index);

void set_network(Vessels& vessels, geometry::Network network);

Gap gap_to_wall(const Plane& p, const Vec3& x, double time);
Gap gap_to_wall(const Capsule& c, const Vec3& x, double time);
Gap gap_to_wall(const Pipette& p, const Vec3& x, double time);

/// um, of the body whose contact with a sphere stands for that with the wall: kFlat, or negative
/// for one that is seen from inside.
double shape_radius(const Plane& p, double time);
double shape_radius(const Capsule& c, double time);
double shape_radius(const Pipette& p, double time);

/// Lets it stay for ever where it is at this moment.
void stop_wall(Plane& p, double time);
void stop_wall(Capsule& c, double time);
void stop_wall(Pipette& p, double time);

/// As messages name it.
std::string wall_label(const Plane& p);
std::string wall_label(const Capsule& c);
std::string wall_label(const Pipette& p);

/// Gap to the walls of one segment, with what gap_to_segment says of its axis. Where there are none
/// within `reach`, um, the gap is to the segment.
Gap gap_to_wall(const Vessels& vessels, int segment, const Vec3& x, double reach);

/// Closest segments of a chain count once: whether the contact of a sphere with `segment` is a
/// local minimum of the distance along the network, so that a straight chain of any spacing gives
/// exactly one contact (docs/decisions/0003.md). Where segments of different radius meet, the
/// nearest one counts.
/// @param gap the sphere centre's gap to this segment
bool is_local_minimum(const Vessels& vessels, int segment, const Vec3& x, const Gap& gap);

}  // namespace acinus::contact
