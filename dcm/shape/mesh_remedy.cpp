#include "dcm/shape/mesh_remedy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "dcm/shape/cast.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "geometry/nearest_rotation.hpp"
#include "geometry/star.hpp"

namespace acinus::dcm {
namespace {

/// Nodes of the sphere mesh for the outer surface of a folded mesh.
constexpr int kOuterNodes = 2562;
/// Largest number of sweeps over poor nodes: enough to relax a mesh ten nodes across.
constexpr int kRemedySweeps = 60;
/// Quality below which a triangle has its nodes relaxed.
constexpr double kMiddling = 0.3;
/// Distance above and below a relaxed node at which the old surface is searched, in mean edges.
constexpr double kReach = 0.5;
/// Number of fits of a candidate to the old surface, and the share of its distance moved in each.
constexpr int kFits = 8;
constexpr double kFit = 0.7;
/// Largest ratio of the distances outside after and before a fit that is worth keeping.
constexpr double kWorthFitting = 0.97;

const Vec3& at(std::span<const Vec3> node, int i) { return node[i]; }

Vec3 face_normal(const geometry::Topology& t, std::span<const Vec3> node, int face) {
  const auto& [i, j, k] = t.triangle[face];
  return (at(node, j) - at(node, i)).cross(at(node, k) - at(node, i)).normalized();
}

double face_quality(const geometry::Topology& t, std::span<const Vec3> node, int face) {
  const auto& [i, j, k] = t.triangle[face];
  return geometry::compute_triangle_quality(at(node, i), at(node, j), at(node, k));
}

/// Rotation that brings the rest shape nearest to these nodes, so that sound parts stay about in
/// place.
Mat3 fit_rotation(const geometry::Topology& t, std::span<const Vec3> node, const Vec3& center) {
  Mat3 moment = Mat3::Zero();
  for (std::size_t i = 0; i < node.size(); ++i)
    moment += (node[i] - center) * t.rest[i].transpose();
  return geometry::nearest_rotation(moment);
}

/// Outer surface of a folded mesh: the last intersections of rays from its centroid.
std::optional<geometry::Surface> cast_outer_surface(const geometry::AuditBody& body) {
  if (body.locate(body.centroid) != geometry::Location::kInside) return std::nullopt;
  const geometry::Topology& sphere = geometry::shared_icosphere(kOuterNodes);
  const double far = 2 * (body.box.high - body.box.low).norm();
  geometry::Surface outer;
  outer.triangle = sphere.triangle;
  for (const Vec3& rest : sphere.rest) {
    const Vec3 ray = far * rest.normalized();
    const std::vector<double> hit = body.crossings(body.centroid, body.centroid + ray);
    if (hit.empty()) return std::nullopt;
    outer.node.push_back(body.centroid + hit.back() * ray);
  }
  return outer;
}

std::optional<std::vector<Vec3>> make_fresh(const geometry::Topology& t, std::span<const Vec3> node,
                                            const geometry::AuditBody& body) {
  const geometry::Surface surface{{node.begin(), node.end()}, t.triangle};
  if (const auto center = geometry::find_star_center(surface))
    return cast_and_spread(t, surface, *center, fit_rotation(t, node, *center));
  const auto outer = cast_outer_surface(body);
  if (!outer) return std::nullopt;
  return cast_and_spread(t, *outer, body.centroid, fit_rotation(t, node, body.centroid));
}

/// Sweeps over the poor nodes of a mesh. A node is poor while a face beside it is of low quality,
/// so that the moving region grows until all faces are good enough.
class Relaxer {
 public:
  Relaxer(const geometry::Topology& t, std::span<const Vec3> node, const geometry::AuditBody& body)
      : topology_(t), body_(body), node_(node.begin(), node.end()) {
    for (const auto& [i, j] : t.edge) length_ += (at(node, i) - at(node, j)).norm() / t.n_edge;
  }

  std::vector<Vec3> run() {
    for (int sweep = 0; sweep < kRemedySweeps; ++sweep) {
      update_normals();
      bool busy = false;
      for (int i = 0; i < topology_.n_node; ++i) busy = improve(i) || busy;
      if (!busy) break;
    }
    return node_;
  }

 private:
  std::span<const int> faces_around(int i) const {
    const std::size_t k = i;
    const std::size_t first = topology_.node_triangle_start[k];
    return std::span(topology_.node_triangle)
        .subspan(first, static_cast<std::size_t>(topology_.node_triangle_start[k + 1]) - first);
  }

  /// Outward directions from the faces of two rings: a few inverted ones are outvoted.
  void update_normals() {
    std::vector<Vec3> one(node_.size(), Vec3::Zero());
    for (int f = 0; f < topology_.n_triangle; ++f) {
      const auto& [i, j, k] = topology_.triangle[f];
      const Vec3 area = (at(node_, j) - at(node_, i)).cross(at(node_, k) - at(node_, i));
      for (const int n : {i, j, k}) one[n] += area;
    }
    normal_ = one;
    for (std::size_t i = 0; i < one.size(); ++i) {
      for (int k = topology_.ring_start[i]; k < topology_.ring_start[i + 1]; ++k)
        normal_[i] += one[topology_.ring[k]];
      normal_[i].normalize();
    }
  }

  /// Worst quality of the faces around a node placed at x; negative if one is inverted.
  double worst_around(int i, const Vec3& x) const {
    double worst = 1;
    for (const int f : faces_around(i)) {
      std::array<Vec3, 3> v;
      for (std::size_t k = 0; k < 3; ++k) {
        const int n = topology_.triangle[f][k];
        v[k] = n == i ? x : at(node_, n);
      }
      const double q = geometry::compute_triangle_quality(v[0], v[1], v[2]);
      const bool turned = (v[1] - v[0]).cross(v[2] - v[0]).dot(normal_[i]) < 0;
      worst = std::min(worst, turned ? -q : q);
    }
    return worst;
  }

  /// Projection of a point onto the outermost layer of the old surface above or below it.
  Vec3 put_on_surface(const Vec3& x, const Vec3& normal) const {
    const Vec3 reach = kReach * length_ * normal;
    const std::vector<double> hit = body_.crossings(x - reach, x + reach);
    return hit.empty() ? body_.closest_point(x) : Vec3(x - reach + 2 * hit.back() * reach);
  }

  /// Moves a poor node towards the middle of the faces around it if that improves them.
  bool improve(int i) {
    const std::size_t k = i;
    const double before = worst_around(i, node_[k]);
    if (before >= kMiddling) return false;
    Vec3 middle = Vec3::Zero();
    for (int n = topology_.ring_start[k]; n < topology_.ring_start[k + 1]; ++n)
      middle += at(node_, topology_.ring[n]);
    middle /= topology_.ring_start[k + 1] - topology_.ring_start[k];
    for (const double part : {1.0, 0.5, 0.2}) {
      const Vec3 to = put_on_surface(node_[k] + part * (middle - node_[k]), normal_[k]);
      // A fold opens only if its nodes may move although they improve nothing at first.
      if (worst_around(i, to) <= before && !(before < 0 && part == 1.0)) continue;
      node_[k] = to;
      return true;
    }
    return false;
  }

  const geometry::Topology& topology_;
  const geometry::AuditBody& body_;
  std::vector<Vec3> node_, normal_;
  double length_ = 0;  ///< um, mean edge
};

struct Old {
  const geometry::Topology& topology;
  std::span<const Vec3> node;
  double radius = 0, edge = 0, volume = 0, area = 0;
  geometry::AuditBody body;
};

/// Distances of the samples of a surface from another, um, positive outside.
std::vector<double> signed_distances(const geometry::AuditBody& surface,
                                     const geometry::AuditBody& from) {
  std::vector<double> out;
  for (const Vec3& x : surface.sample) {
    const double distance = from.distance(x);
    out.push_back(from.locate(x) == geometry::Location::kOutside ? distance : -distance);
  }
  return out;
}

SurfaceShift find_shift(const geometry::AuditBody& old_body, const geometry::AuditBody& new_body,
                        const std::vector<double>& distance) {
  SurfaceShift shift;
  shift.outside = std::max(0.0, *std::ranges::max_element(distance));
  shift.inside = std::max(0.0, -*std::ranges::min_element(distance));
  for (const Vec3& x : old_body.sample)
    if (new_body.locate(x) == geometry::Location::kOutside)
      shift.lost = std::max(shift.lost, new_body.distance(x));
  return shift;
}

/// Moves the nodes along their normals so that the new surface deviates from the old one as little
/// outside as inside: faces bridge a valley, and their nodes should not lie on its rims.
/// @param distance  of the samples of `body`, the surface of these nodes
void fit_surface(const geometry::Topology& t, const geometry::AuditBody& body,
                 const std::vector<double>& distance, std::span<Vec3> node) {
  std::vector<double> sum(node.size(), 0.0), weight(node.size(), 0.0);
  std::size_t sample = 0;
  const auto count_for = [&](int i, double d) {  // the farthest count
    sum[i] += d * d * d;
    weight[i] += d * d;
  };
  for (int i = 0; i < t.n_node; ++i) count_for(i, distance[sample++]);
  for (const auto& end : body.edge) {
    for (const int i : end) count_for(i, distance[sample]);
    ++sample;
  }
  std::vector<Vec3> area(node.size(), Vec3::Zero());
  for (const auto& corner : t.triangle) {
    const Vec3& a = at(node, corner[0]);
    const Vec3 part = (at(node, corner[1]) - a).cross(at(node, corner[2]) - a);
    for (const int i : corner) {
      count_for(i, distance[sample]);
      area[i] += part;
    }
    ++sample;
  }
  for (std::size_t i = 0; i < node.size(); ++i)
    if (weight[i] > 0) node[i] -= kFit * sum[i] / weight[i] * area[i].normalized();
}

/// True if a candidate is sound; its measures go to `m`.
bool is_sound(const Old& old, std::span<const Vec3> node, Mended& m) {
  m.after = measure_health(old.topology, node, old.radius);
  m.area_change = geometry::compute_area(node, old.topology.triangle) / old.area - 1;
  const bool better = m.after.quality > m.before.quality || m.after.spacing > m.before.spacing ||
                      m.after.opposed > m.before.opposed;
  m.why.clear();
  if (!better || is_suspicious(m.after) || m.after.quality < kGoodQuality ||
      m.after.spacing < kGoodSpacing)
    m.why = fmt::format("the new mesh is no better: quality {:.2g}, spacing {:.2g}, fold {:.2g}",
                        m.after.quality, m.after.spacing, m.after.opposed);
  else if (std::abs(m.area_change) > kMostAreaChange)
    m.why = fmt::format("the surface would change by {:.2g} %", 100 * m.area_change);
  return m.why.empty();
}

/// Gives a candidate the old volume, fits it to the old surface and rates it by the finer limit.
void rate(const Old& old, std::vector<Vec3> node, Mended& m) {
  const std::vector<double> all(node.size(), 1.0);
  double best = std::numeric_limits<double>::infinity();
  for (int fit = 0; fit <= kFits; ++fit) {
    Mended now = m;
    if (!match_volume(old.topology, old.volume, all, node)) {
      if (fit == 0) m.why = "the volume cannot be kept";
      return;
    }
    if (!is_sound(old, node, now)) {
      if (fit == 0) m = now;
      return;
    }
    const geometry::AuditBody body(node, old.topology.triangle);
    const std::vector<double> distance = signed_distances(body, old.body);
    now.shift = find_shift(old.body, body, distance);
    if (now.shift.outside > kWorthFitting * best) return;
    best = now.shift.outside;
    if (!is_within(now.shift, kLimit, old.edge))
      now.why = fmt::format("the surface would shift: {:.2g} um out, {:.2g} um in, {:.2g} um lost",
                            now.shift.outside, now.shift.inside, now.shift.lost);
    else if (body.self_intersects())
      now.why = "the new mesh crosses itself";
    now.ok = now.why.empty();
    now.node = node;
    if (now.ok || !m.ok) m = now;
    if (m.ok && is_within(m.shift, kFineLimit, old.edge)) return;
    fit_surface(old.topology, body, distance, node);
  }
}

}  // namespace

MeshHealth measure_health(const geometry::Topology& t, std::span<const Vec3> node, double radius) {
  MeshHealth h;
  std::vector<Vec3> normal(t.triangle.size());
  for (int f = 0; f < t.n_triangle; ++f) {
    normal[f] = face_normal(t, node, f);
    h.quality = std::min(h.quality, face_quality(t, node, f));
  }
  double shortest2 = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    const auto& [i, j] = t.edge[e];
    const auto& [a, b] = t.edge_triangle[e];
    shortest2 = std::min(shortest2, (at(node, i) - at(node, j)).squaredNorm());
    h.opposed = std::min(h.opposed, normal[a].dot(normal[b]));
  }
  h.spacing = std::sqrt(shortest2) / (t.mean_rest_length * radius);
  return h;
}

SurfaceShift compare_surfaces(const geometry::Topology& t, std::span<const Vec3> old_node,
                              std::span<const Vec3> new_node) {
  const geometry::AuditBody from(old_node, t.triangle), to(new_node, t.triangle);
  return find_shift(from, to, signed_distances(to, from));
}

Mended mend_mesh(const geometry::Topology& t, std::span<const Vec3> node, double radius) {
  Mended m;
  m.before = measure_health(t, node, radius);
  const double volume = geometry::compute_volume(node, t.triangle);
  m.why = "it has no volume";
  if (!(volume > 0)) return m;
  const Old old{t,
                node,
                radius,
                t.mean_rest_length * radius,
                volume,
                geometry::compute_area(node, t.triangle),
                geometry::AuditBody(node, t.triangle)};
  m.crossed = old.body.self_intersects();
  Mended fresh = m, relaxed = m;
  fresh.method = "fresh";
  fresh.why = "it is not seen whole from inside";
  if (auto cast = make_fresh(t, node, old.body)) rate(old, std::move(*cast), fresh);
  if (fresh.ok && is_within(fresh.shift, kFineLimit, old.edge)) return fresh;
  relaxed.method = "relaxed";
  rate(old, Relaxer(t, node, old.body).run(), relaxed);
  if (!relaxed.ok) return fresh.ok ? fresh : relaxed;
  return fresh.ok && fresh.shift.outside <= relaxed.shift.outside ? fresh : relaxed;
}

}  // namespace acinus::dcm
