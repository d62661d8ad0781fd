#pragma once
/// Boundary of the cells. Its obstacles are walls (planes, capsules, pipettes), vessels and static
/// meshes.

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

// Walls: obstacles given by a formula. Each has a name, may move and may vanish. A kind of wall
// consists of a struct with name, material and opens, a Partner, a line in for_each_wall and one
// overload of each function below; all code that handles walls goes through these.

/// Half space (x - point).normal >= 0 that cells stay in. It may move along its normal and may
/// vanish.
struct Plane {
  std::string name;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  double speed = 0;   ///< um/s along the normal
  double travel = 0;  ///< um, distance after which the motion stops
  Material material{.mirror = true};
  double opens = std::numeric_limits<double>::infinity();  ///< s, time at which it vanishes
  Vec3 point_at(double time) const;  ///< out of any cell's reach once it vanished
};

/// Rigid sphere seen from inside. It may shrink and may vanish.
struct Capsule {
  std::string name;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double speed = 0;  ///< um/s, shrink rate
  double min_radius = 0;
  double opens = std::numeric_limits<double>::infinity();  ///< s, time at which it vanishes
  Material material;
  double radius_at(double time) const;  ///< infinite once it vanished
};

/// Rigid tube with a rounded rim at both ends. Cells touch its inside, its outside and its rims. In
/// a section along the axis the tube wall is a rectangle with rounded corners.
struct Pipette {
  std::string name;
  Vec3 mouth = Vec3::Zero();  ///< centre of the plane in which the tube begins
  Vec3 axis = Vec3::UnitZ();  ///< unit, from the mouth into the tube
  double radius = 0;          ///< um, inner
  double thickness = 3;       ///< um, of the wall
  double lip = 1;             ///< um, radius of the rims; at most half the thickness and the length
  double length = 100;        ///< um, along the axis
  double opens = std::numeric_limits<double>::infinity();  ///< s, time at which it vanishes
  Material material;
};

struct Vessels {
  geometry::Network network;
  /// Surface that cells touch in place of the cones of the network; null: the cones.
  std::shared_ptr<const WallMesh> wall;
  Material material = kVesselMaterial;
  std::vector<std::vector<int>> segments_of_node;  ///< [node] segments that end there
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

/// Radius of the sphere that stands for the wall in the contact law of two spheres, um: kFlat for a
/// flat wall, negative for one seen from inside.
double shape_radius(const Plane& p, double time);
double shape_radius(const Capsule& c, double time);
double shape_radius(const Pipette& p, double time);

/// Freeze a wall in its state at `time`: it no longer moves or vanishes.
void stop_wall(Plane& p, double time);
void stop_wall(Capsule& c, double time);
void stop_wall(Pipette& p, double time);

/// Name of a wall in messages.
std::string wall_label(const Plane& p);
std::string wall_label(const Capsule& c);
std::string wall_label(const Pipette& p);

/// Gap to the surface about the vessels at one segment, with the axis data of gap_to_segment. Where
/// this surface has no triangle within `reach`, um, the gap is that to the cone of the segment.
Gap gap_to_wall(const Vessels& vessels, int segment, const Vec3& x, double reach);

/// True if the contact of a sphere with `segment` is a local minimum of the distance along the
/// network. A straight chain of any spacing then gives exactly one contact
/// (decision 3). At a joint of segments of different radius the nearest segment counts.
/// @param gap  of the sphere's centre to this segment
bool is_local_minimum(const Vessels& vessels, int segment, const Vec3& x, const Gap& gap);

}  // namespace acinus::contact
