#include "contact/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "contact/hertz.hpp"
#include "core/error.hpp"
#include "core/numbers/time_grid.hpp"

namespace acinus::contact {
namespace {

constexpr double kEnd = 1e-9;  ///< distance from 0 or 1 at which a parameter is at the end
constexpr double kGone = 1e9;  ///< um, displacement of a wall that vanished

}  // namespace

Vec3 Plane::point_at(double time) const {
  // A step that ends at the time at which a wall vanishes still includes it.
  if (time > opens + kSameTime) return point - kGone * normal;
  const double moved = std::min(std::abs(speed) * std::max(time, 0.0), travel);
  return point + std::copysign(moved, speed) * normal;
}

double Capsule::radius_at(double time) const {
  if (time > opens + kSameTime) return std::numeric_limits<double>::infinity();
  return std::max(min_radius, radius - speed * std::max(time, 0.0));
}

bool Boundary::empty() const {
  bool none = vessels.network.segment.empty() && meshes.empty();
  for_each_wall(*this, [&](auto, auto, const auto&) { none = false; });
  return none;
}

void set_network(Vessels& v, geometry::Network network) {
  v.network = std::move(network);
  v.segments_of_node.assign(v.network.node.size(), {});
  for (std::size_t s = 0; s < v.network.segment.size(); ++s)
    for (int n : v.network.segment[s]) v.segments_of_node[n].push_back(static_cast<int>(s));
}

const Material& material_of(const Boundary& boundary, Partner obstacle, int index) {
  const std::size_t mesh = index;
  if (obstacle == Partner::kVessel) return boundary.vessels.material;
  if (obstacle == Partner::kMesh) return boundary.meshes[mesh].material;
  const Material* found = nullptr;
  for_each_wall(boundary, [&](Partner kind, int i, const auto& wall) {
    if (kind == obstacle && i == index) found = &wall.material;
  });
  ACINUS_ASSERT(found != nullptr);
  return *found;
}

Gap gap_to_wall(const Plane& p, const Vec3& x, double time) {
  return {(x - p.point_at(time)).dot(p.normal), p.normal, 0, 0, 0};
}

Gap gap_to_wall(const Capsule& c, const Vec3& x, double time) {
  const Vec3 d = x - c.center;
  const double r = d.norm();
  return {c.radius_at(time) - r, r > 0 ? Vec3(-d / r) : Vec3::UnitZ(), 0, 0, 0};
}

Gap gap_to_wall(const Pipette& p, const Vec3& x, double time) {
  if (time > p.opens + kSameTime)
    return {std::numeric_limits<double>::infinity(), Vec3::UnitZ(), 0, 0, 0};
  const Vec3 d = x - p.mouth;
  const double along = d.dot(p.axis);
  const Vec3 across = d - along * p.axis;
  const double r = across.norm();
  // Position relative to the middle of the rectangle, then relative to the sides of the smaller
  // rectangle about whose corners the rounding is centred.
  const double u = r - p.radius - 0.5 * p.thickness, v = along - 0.5 * p.length;
  const double side = std::abs(u) - 0.5 * p.thickness + p.lip,
               end = std::abs(v) - 0.5 * p.length + p.lip;
  const Vec3 to_side =
      std::copysign(1.0, u) * (r > 0 ? Vec3(across / r) : Vec3(p.axis.unitOrthogonal()));
  const Vec3 to_end = std::copysign(1.0, v) * p.axis;
  if (side > 0 && end > 0) {
    const double distance = std::hypot(side, end);
    return {distance - p.lip, (side * to_side + end * to_end) / distance, 0, 0, 0};
  }
  if (side > end) return {side - p.lip, to_side, 0, 0, 0};
  return {end - p.lip, to_end, 0, 0, 0};
}

double shape_radius(const Plane&, double) { return kFlat; }

double shape_radius(const Capsule& c, double time) { return -c.radius_at(time); }

double shape_radius(const Pipette&, double) { return kFlat; }

void stop_wall(Plane& p, double time) {
  p.point = p.point_at(time);  // far away if it vanished
  p.opens = Plane{}.opens;
  p.speed = 0;
}

void stop_wall(Capsule& c, double time) {
  c.radius = c.radius_at(time);
  c.speed = 0;  // one that vanished has an infinite radius
}

void stop_wall(Pipette& p, double time) {
  if (time > p.opens + kSameTime) p.mouth = Vec3::Constant(kGone);
  p.opens = Pipette{}.opens;
}

std::string wall_label(const Plane& p) { return fmt::format("wall \"{}\"", p.name); }

std::string wall_label(const Capsule& c) { return "the wall of the " + c.name; }

std::string wall_label(const Pipette& p) { return "the wall of the " + p.name; }

Gap gap_to_wall(const Vessels& vessels, int segment, const Vec3& x, double reach) {
  Gap gap = gap_to_segment(vessels.network, segment, x);
  if (!vessels.wall) return gap;
  const WallMesh& wall = *vessels.wall;
  const std::size_t first = wall.first_of_segment[segment],
                    last = wall.first_of_segment[static_cast<std::size_t>(segment) + 1];
  const Gap found = gap_to_triangles(
      wall.surface.body, std::span(wall.of_segment).subspan(first, last - first), x, reach);
  if (found.gap >= reach) return gap;
  gap.gap = found.gap;
  gap.normal = found.normal;
  return gap;
}

bool is_local_minimum(const Vessels& vessels, int segment, const Vec3& x, const Gap& gap) {
  const auto at_start = [](const Gap& g) { return g.parameter <= kEnd; };
  const auto at_finish = [](const Gap& g) { return g.parameter >= 1 - kEnd; };
  const auto& joint = vessels.network.segment;
  const auto& own = joint[segment];
  for (int k : {0, 1}) {
    const int node = own[k];
    const bool here = k == 0 ? at_start(gap) : at_finish(gap);
    for (int other : vessels.segments_of_node[node]) {
      if (other == segment) continue;
      const Gap o = gap_to_segment(vessels.network, other, x);
      const bool starts_here = joint[other][0] == node;
      const bool there = starts_here ? at_start(o) : at_finish(o);
      if (here || there) {
        // Both segments describe the surface about this joint, and the nearer one counts: segments
        // may differ in radius at a joint. On a tie a side wall comes first, then the lower number.
        if (o.gap < gap.gap - kEnd) return false;
        if (here && o.gap <= gap.gap + kEnd && (!there || other < segment)) return false;
      }
    }
  }
  return true;
}

}  // namespace acinus::contact
