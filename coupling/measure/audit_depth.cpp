#include "coupling/measure/audit_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace acinus::coupling {
namespace {

/// Probe positions of a passing edge between two neighbouring crossings.
constexpr std::array<double, 3> kProbe{0.25, 0.5, 0.75};

/// Calls f(point on a-b) at probes of every piece between neighbouring crossings.
template <class F>
void probe_pieces(const Vec3& a, const Vec3& b, const std::vector<double>& crossing, F&& f) {
  for (std::size_t c = 0; c + 1 < crossing.size(); ++c)
    for (const double probe : kProbe)
      f(Vec3(a + (crossing[c] + probe * (crossing[c + 1] - crossing[c])) * (b - a)));
}

/// Depth of the volume centroid of `a` if it is inside both bodies, um.
double common_centroid_depth(const geometry::AuditBody& a, const geometry::AuditBody& b) {
  if (a.locate(a.centroid) != geometry::Location::kInside ||
      b.locate(a.centroid) != geometry::Location::kInside)
    return 0;
  return std::min(a.distance(a.centroid), b.distance(a.centroid));
}

/// Point of segment p-q nearest to segment a-b. With the parameter of one segment fixed, the best
/// of the other is a clamped projection; two rounds from the unclamped solution give the minimising
/// pair.
Vec3 nearest_on_segment(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const Vec3 u = q - p, v = b - a, w = p - a;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const double det = uu * vv - uv * uv;
  const auto project = [](const Vec3& x, const Vec3& from, const Vec3& way, double squared) {
    return squared > 0 ? std::clamp((x - from).dot(way) / squared, 0.0, 1.0) : 0.0;
  };
  double s = det > 1e-14 * uu * vv ? (uv * v.dot(w) - vv * u.dot(w)) / det : 0.5;
  s = std::clamp(s, 0.0, 1.0);
  const double t = project(p + s * u, a, v, vv);
  s = project(a + t * v, p, u, uu);
  return p + s * u;
}

}  // namespace

Box RoundCone::box() const {
  const Box hull = sphere_box(a, radius_a), end = sphere_box(b, radius_b);
  return {hull.low.cwiseMin(end.low), hull.high.cwiseMax(end.high)};
}

double surface_depth(const geometry::AuditBody& a, const geometry::AuditBody& b,
                     geometry::Location forbidden) {
  double depth = 0;
  const auto look = [&](const Vec3& point) {
    if (forbidden == geometry::Location::kInside && !b.box.contains(point)) return false;
    if (b.locate(point) != forbidden) return false;
    depth = std::max(depth, b.distance(point));
    return true;
  };
  std::vector<char> bad(a.n_node);
  for (std::size_t s = 0; s < a.sample.size(); ++s) {
    const bool is_bad = look(a.sample[s]);
    if (s < bad.size()) bad[s] = is_bad;
  }
  for (const auto& [i, j] : a.edge) {
    if (bad[i] || bad[j]) continue;
    const Vec3 &from = a.sample[i], &to = a.sample[j];
    if (forbidden == geometry::Location::kInside && !b.box.overlaps(segment_box(from, to)))
      continue;
    probe_pieces(from, to, b.crossings(from, to), look);
  }
  return depth;
}

double body_depth(const geometry::AuditBody& a, const geometry::AuditBody& b) {
  return std::max({surface_depth(a, b, geometry::Location::kInside),
                   surface_depth(b, a, geometry::Location::kInside), common_centroid_depth(a, b),
                   common_centroid_depth(b, a)});
}

// The best ball is the one whose surface normal passes through p: with the slope s = (ra - rb)/L
// it sits s/sqrt(1 - s^2) times the distance from the axis behind the foot of p.
double cone_depth(const RoundCone& cone, const Vec3& p) {
  const Vec3 along = cone.b - cone.a;
  const double length = along.norm();
  const double drop = cone.radius_a - cone.radius_b;
  double t = drop > 0 ? 0 : 1;  // one ball swallows the other
  if (std::abs(drop) < length) {
    const double slope = drop / length;
    const double foot = (p - cone.a).dot(along) / length;
    const double off = (p - cone.a - foot / length * along).norm();
    t = std::clamp((foot - off * slope / std::sqrt(1 - slope * slope)) / length, 0.0, 1.0);
  }
  return cone.radius(t) - (p - cone.a - t * along).norm();
}

double vessel_depth(const geometry::AuditBody& cell, const RoundCone& cone) {
  const Box box = cone.box();
  double depth = 0;
  const auto on_surface = [&](const Vec3& x) { depth = std::max(depth, cone_depth(cone, x)); };
  for (const Vec3& x : cell.sample)
    if (box.contains(x)) on_surface(x);
  for (const auto& [i, j] : cell.edge) {
    const Vec3 &from = cell.sample[i], &to = cell.sample[j];
    if (box.overlaps(segment_box(from, to)))
      on_surface(nearest_on_segment(from, to, cone.a, cone.b));
  }
  // A thin vessel can end in or pass through the middle of a triangle, away from every sample.
  const std::vector<double> crossing = cell.crossings(cone.a, cone.b);
  const auto on_axis = [&](const Vec3& x) {
    const Vec3 near = cell.closest_point(x);
    on_surface(near);
    if (cell.locate(x) != geometry::Location::kInside) return;
    const double length = (cone.b - cone.a).norm();
    const double t = length > 0 ? (x - cone.a).norm() / length : 0.0;
    depth = std::max(depth, cone.radius(t) + (x - near).norm());
  };
  on_axis(cone.a);
  on_axis(cone.b);
  for (const double t : crossing) on_surface(cone.a + t * (cone.b - cone.a));
  std::vector<double> stop{0.0};
  stop.insert(stop.end(), crossing.begin(), crossing.end());
  stop.push_back(1.0);
  if (!crossing.empty()) probe_pieces(cone.a, cone.b, stop, on_axis);
  return depth;
}

}  // namespace acinus::coupling
