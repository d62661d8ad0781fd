#include "contact/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/hertz.hpp"
#include "core/error.hpp"
#include "core/numbers/time_grid.hpp"
#include "geometry/closest_point.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::contact {
namespace {

constexpr double kEnd = 1e-9;  ///< parameters this near 0 or 1 are the segment's end
constexpr double kGone = 1e9;  ///< um behind its place

/// Looks for the place of a surface that is nearest to a point, triangle by triangle.
struct NearestTriangle {
  const SurfaceBody& b;
  const Vec3& x;
  double reach;  ///< um, of interest
  Gap gap;       ///< so far
  double least2;

  NearestTriangle(const SurfaceBody& body, const Vec3& point, double within)
      : b(body),
        x(point),
        reach(within),
        gap{within, Vec3::UnitZ(), 0, 0, 0},
        least2(within * within) {}

  void look(std::size_t t) {
    const double far = reach + b.reach[t];
    if ((x - b.center[t]).squaredNorm() > far * far) return;
    const auto& corner = (*b.triangle)[t];
    const geometry::ClosestPoint c =
        geometry::find_closest_point(x, b.node[corner[0]], b.node[corner[1]], b.node[corner[2]]);
    if (c.squared_distance >= least2) return;
    least2 = c.squared_distance;
    Vec3 out = Vec3::Zero();
    for (int m = 0; m < 3; ++m) out += c.weight[m] * b.node_normal[corner[m]];
    out.normalize();
    const Vec3 apart = x - c.point;
    const double sign = apart.dot(out) >= 0 ? 1.0 : -1.0, distance = std::sqrt(least2);
    gap.gap = sign * distance;
    gap.normal = distance > 0 ? Vec3(sign / distance * apart) : out;
  }
};

}  // namespace

Vec3 Plane::point_at(double time) const {
  // A step that ends in the moment a wall vanishes still meets it.
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

StaticMesh make_static_mesh(std::string name, geometry::Surface surface, bool inside) {
  if (inside)
    for (auto& t : surface.triangle) std::swap(t[1], t[2]);
  StaticMesh m;
  m.name = std::move(name);
  m.inside = inside;
  m.triangle = std::make_shared<const std::vector<std::array<int, 3>>>(std::move(surface.triangle));
  m.body.node = std::move(surface.node);
  m.body.triangle = m.triangle.get();
  refresh_body(m.body);
  return m;
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
  // From the middle of the rectangle, and from the sides of the smaller one that the corners go
  // round.
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
  p.point = p.point_at(time);  // far away if it is gone
  p.opens = Plane{}.opens;
  p.speed = 0;
}

void stop_wall(Capsule& c, double time) {
  c.radius = c.radius_at(time);
  c.speed = 0;  // and one that is open has an infinite radius
}

void stop_wall(Pipette& p, double time) {
  if (time > p.opens + kSameTime) p.mouth = Vec3::Constant(kGone);
  p.opens = Pipette{}.opens;
}

std::string wall_label(const Plane& p) { return fmt::format("wall \"{}\"", p.name); }

std::string wall_label(const Capsule& c) { return "the wall of the " + c.name; }

std::string wall_label(const Pipette& p) { return "the wall of the " + p.name; }

Gap gap_to_mesh(const SurfaceBody& b, const Vec3& x, double reach) {
  NearestTriangle nearest(b, x, reach);
  for (std::size_t t = 0; t < b.triangle->size(); ++t) nearest.look(t);
  return nearest.gap;
}

Gap gap_to_triangles(const SurfaceBody& b, std::span<const int> triangles, const Vec3& x,
                     double reach) {
  NearestTriangle nearest(b, x, reach);
  for (const int t : triangles) nearest.look(static_cast<std::size_t>(t));
  return nearest.gap;
}

Gap gap_to_segment(const geometry::Network& network, int segment, const Vec3& x) {
  const geometry::NearestBall ball = geometry::nearest_ball(network, segment, x);
  Gap g;
  g.axis_distance = ball.apart.norm();
  g.radius = ball.radius;
  g.gap = g.axis_distance - g.radius;
  g.parameter = ball.parameter;
  if (g.axis_distance > 0) {
    g.normal = ball.apart / g.axis_distance;
  } else {  // on the axis every direction is out
    const auto& [a, b] = network.segment[segment];
    g.normal = (network.node[b] - network.node[a]).unitOrthogonal();
  }
  return g;
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
        // Both describe the surface about this joint, and the nearer one counts: segments may
        // differ in radius where they meet. On a tie a side wall goes first, then the lower number.
        if (o.gap < gap.gap - kEnd) return false;
        if (here && o.gap <= gap.gap + kEnd && (!there || other < segment)) return false;
      }
    }
  }
  return true;
}

}  // namespace acinus::contact
