#include "coupling/measure/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/measure/audit_depth.hpp"
#include "coupling/measure/audit_queries.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::coupling {
namespace {

/// Least distance of sisters, in radii of cells about to divide: they are born 2 (R_m - R_d) apart
/// (cbm::divide) and grow in place.
const double kSisterDistance = 2 - std::cbrt(4.0);

/// @param a  cell or sphere that comes first
template <class Body>
void keep_worst(WorstPair& worst, double depth, const Body& a, std::int64_t b) {
  if (depth > worst.depth_um) worst = {depth, {a.id, b}, a.number};
}

/// Records a forbidden depth of a pair, with or without a newborn cell.
void keep_penetration(AuditResult& result, double depth, bool newborn) {
  result.max_penetration_um = std::max(result.max_penetration_um, depth);
  if (!newborn) result.max_penetration_grown_um = std::max(result.max_penetration_grown_um, depth);
}

void check_finite(std::span<const Vec3> nodes, const std::string& what) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    check(nodes[i].allFinite(), fmt::format("audit: {}: node {} is not finite", what, i),
          Exit::kCannotContinue);
}

/// Boxes of the cells and the segments of the vessels.
struct Bodies {
  std::vector<Box> cell;
  std::vector<RoundCone> cone;  ///< empty where cells touch the surface of the vessels
};

Bodies prepare(const AuditFrame& frame) {
  for (const AuditMesh& m : frame.meshes) check_finite(m.node, fmt::format("cell {}", m.id));
  for (const AuditSphere& s : frame.spheres)
    check_finite(std::span(&s.center, 1), fmt::format("sphere {}", s.id));
  Bodies bodies;
  bodies.cell.resize(frame.meshes.size());
  for (std::size_t c = 0; c < bodies.cell.size(); ++c)
    for (const Vec3& x : frame.meshes[c].node) bodies.cell[c].include(x);
  if (!frame.vessels || frame.vessel_surface) return bodies;
  const geometry::Network& net = *frame.vessels;
  for (std::size_t s = 0; s < net.segment.size(); ++s)
    bodies.cone.push_back({net.node[net.segment[s][0]], net.node[net.segment[s][1]],
                           net.radius[s][0], net.radius[s][1]});
  return bodies;
}

/// Depth of a sphere beyond the surface of a closed body on the forbidden side, um.
double depth_in_fixed(const AuditSphere& sphere, const geometry::AuditBody& fixed,
                      geometry::Location forbidden) {
  const double distance = fixed.distance(sphere.center);
  return sphere.radius + (fixed.locate(sphere.center) == forbidden ? distance : -distance);
}

void audit_spheres_at_walls(const AuditFrame& frame, AuditResult& result) {
  for (const AuditSphere& s : frame.spheres) {
    if (!s.own) continue;
    std::int64_t wall = 0;
    const auto keep = [&](double depth) { keep_worst(result.cbm_wall, depth, s, wall++); };
    for (const AuditWall& w : frame.walls) keep(depth_behind(w, s.center, s.radius));
    for (std::size_t f = 0; f < frame.static_meshes.size(); ++f) {
      const double depth =
          depth_in_fixed(s, frame.static_meshes[f].body,
                         frame.static_meshes[f].inside ? geometry::Location::kOutside
                                                       : geometry::Location::kInside);
      keep(depth);
      keep_worst(result.center_in_static, depth - s.radius, s, static_cast<std::int64_t>(f));
    }
  }
}

/// Spheres at the surface of the vessels.
void audit_vessel_surface(const AuditFrame& frame, AuditResult& result) {
  if (!frame.vessel_surface) return;
  const geometry::AuditBody& surface = *frame.vessel_surface;
  std::vector<double> depth(frame.spheres.size(), 0.0);
  for_each_part(depth.size(), [&](std::size_t k) {
    const AuditSphere& s = frame.spheres[k];
    if (s.own && surface.box.overlaps(sphere_box(s.center, s.radius)))
      depth[k] = depth_in_fixed(s, surface, geometry::Location::kInside);
  });
  for (std::size_t k = 0; k < depth.size(); ++k) {
    if (depth[k] <= result.cbm_vessel.depth_um) continue;
    const AuditSphere& s = frame.spheres[k];
    keep_worst(result.cbm_vessel, depth[k], s,
               geometry::nearest_segment(*frame.vessels, s.center).segment);
  }
}

double sphere_overlap(const AuditSphere& a, const AuditSphere& b) {
  const double distance = (a.center - b.center).norm(), depth = a.radius + b.radius - distance;
  const bool sisters = a.mother >= 0 && a.mother == b.mother;
  if (!sisters || depth <= std::max(a.radius, b.radius)) return depth;
  const bool weak = a.strength < 1 || b.strength < 1;
  return weak || distance >= kSisterDistance * 0.5 * (a.radius + b.radius) ? 0 : depth;
}

/// Deepest pair so far; of equal depths the first pair in ascending order.
struct DeepestPair {
  double depth = 0;
  std::pair<std::size_t, std::size_t> pair;

  void keep(double d, std::size_t a, std::size_t b) {
    const std::pair now(a, b);
    if (d < depth || !(d > 0) || (d == depth && pair < now)) return;
    depth = d;
    pair = now;
  }
};

/// Queries about cells, ascending: of each cell by itself, then with its surroundings, then with
/// the bodies whose boxes meet its own. Pairs of spheres, and of spheres with vessels, are audited
/// at once, without a list: they are many, and cheap.
std::vector<AuditQuery> find_queries(const AuditFrame& frame, const Bodies& bodies,
                                     AuditResult& result) {
  using Partner = AuditPartner;
  std::vector<Box> box = bodies.cell;
  for (const AuditSphere& s : frame.spheres) box.push_back(sphere_box(s.center, s.radius));
  for (const RoundCone& c : bodies.cone) box.push_back(c.box());
  for (const AuditStaticMesh& s : frame.static_meshes) box.push_back(s.body.box);
  const std::size_t sphere = bodies.cell.size(), cone = sphere + frame.spheres.size();
  const std::size_t fixed = cone + bodies.cone.size();
  std::vector<AuditQuery> query;
  for (std::size_t c = 0; c < sphere; ++c) {
    if (!frame.meshes[c].own) continue;
    query.push_back({Partner::kNone, c, 0});
    for (std::size_t f = 0; f < frame.static_meshes.size(); ++f)
      if (frame.static_meshes[f].inside) query.push_back({Partner::kEnvelope, c, f});
    if (frame.vessel_surface != nullptr && bodies.cell[c].overlaps(frame.vessel_surface->box))
      query.push_back({Partner::kVesselSurface, c, 0});
  }
  DeepestPair spheres, vessels;
  geometry::for_each_meeting(box, [&](std::size_t a, std::size_t b) {  // a < b: cells come first
    if (a < sphere ? !frame.meshes[a].own : a < cone && !frame.spheres[a - sphere].own) return;
    if (a < sphere) {
      if (b < sphere)
        query.push_back({Partner::kCell, a, b});
      else if (b < cone)
        query.push_back({Partner::kSphere, a, b - sphere});
      else if (b < fixed)
        query.push_back({Partner::kCone, a, b - cone});
      else if (!frame.static_meshes[b - fixed].inside)
        query.push_back({Partner::kFixed, a, b - fixed});
    } else if (a < cone && b < cone) {
      const std::size_t i = a - sphere, j = b - sphere;
      spheres.keep(sphere_overlap(frame.spheres[i], frame.spheres[j]), i, j);
    } else if (a < cone && b < fixed) {
      const AuditSphere& s = frame.spheres[a - sphere];
      vessels.keep(s.radius + cone_depth(bodies.cone[b - cone], s.center), a - sphere, b - cone);
    }
  });
  std::ranges::sort(query, {}, [](const AuditQuery& q) { return std::tuple(q.a, q.partner, q.b); });
  const auto& [i, j] = spheres.pair;
  if (spheres.depth > 0)
    keep_worst(result.cbm_cbm, spheres.depth, frame.spheres[i], frame.spheres[j].id);
  if (vessels.depth > 0)
    keep_worst(result.cbm_vessel, vessels.depth, frame.spheres[vessels.pair.first],
               static_cast<std::int64_t>(vessels.pair.second));
  return query;
}

void keep_cell(const AuditMesh& cell, const AuditAnswer& answer, AuditResult& result) {
  result.n_inverted += answer.volume <= 0;
  result.n_self_intersecting += answer.self_intersects;
  if (answer.quality < result.min_triangle_quality || result.worst_triangle_cell < 0) {
    result.min_triangle_quality = answer.quality;
    result.worst_triangle_cell = cell.id;
    result.worst_triangle_number = cell.number;
  }
}

/// Walls, behind which no node may be, near or not.
void audit_walls(const AuditFrame& frame, const AuditMesh& cell, AuditResult& result) {
  for (std::size_t w = 0; w < frame.walls.size(); ++w)
    for (const Vec3& x : cell.node) {
      const double depth = depth_behind(frame.walls[w], x, 0);
      keep_worst(result.dcm_wall, depth, cell, static_cast<std::int64_t>(w));
      keep_penetration(result, depth, cell.newborn);
    }
}

void keep_indentation(const AuditFrame& frame, const AuditMesh& cell, std::int64_t sphere,
                      double depth, AuditResult& result) {
  const auto indentation = std::ranges::find_if(frame.indentations, [&](const KnownIndentation& d) {
    return d.mesh_id == cell.id && d.sphere_id == sphere;
  });
  const double explained =
      indentation == frame.indentations.end() ? 0 : std::max(0.0, indentation->depth);
  const double beyond = std::max(0.0, depth - explained);
  keep_penetration(result, beyond, cell.newborn);
  keep_worst(result.dcm_cbm_beyond_indentation, beyond, cell, sphere);
  keep_worst(result.dcm_cbm, depth, cell, sphere);
}

void keep(const AuditFrame& frame, const Bodies& bodies, const AuditQuery& q,
          const AuditAnswer& answer, AuditResult& result) {
  using Partner = AuditPartner;
  const AuditMesh& cell = frame.meshes[q.a];
  const auto other = static_cast<std::int64_t>(q.b),
             n_wall = static_cast<std::int64_t>(frame.walls.size());
  const double depth = answer.depth;
  switch (q.partner) {
    case Partner::kNone:
      keep_cell(cell, answer, result);
      return audit_walls(frame, cell, result);
    case Partner::kCell: {
      const AuditMesh& second = frame.meshes[q.b];
      keep_penetration(result, depth, cell.newborn || second.newborn);
      return keep_worst(result.dcm_dcm, depth, cell, second.id);
    }
    case Partner::kSphere:
      return keep_indentation(frame, cell, frame.spheres[q.b].id, depth, result);
    case Partner::kCone:
      keep_penetration(result, depth, cell.newborn);
      return keep_worst(result.dcm_vessel, depth, cell, other);
    case Partner::kFixed:
    case Partner::kEnvelope:
      keep_penetration(result, depth, cell.newborn);
      return keep_worst(result.dcm_wall, depth, cell, n_wall + other);
    case Partner::kVesselSurface: {
      keep_penetration(result, depth, cell.newborn);
      if (depth <= result.dcm_vessel.depth_um) return;
      const Vec3 at = 0.5 * (bodies.cell[q.a].low + bodies.cell[q.a].high);
      return keep_worst(result.dcm_vessel, depth, cell,
                        geometry::nearest_segment(*frame.vessels, at).segment);
    }
  }
}

/// Pair of a process as it is sent; n_id = 0: none.
struct SentPair {
  double depth = 0;
  std::size_t number = 0;
  std::int64_t n_id = 0;
  std::array<std::int64_t, 2> id{};

  bool is_worse_than(const SentPair& o) const {
    if (n_id == 0 || o.n_id == 0) return n_id > o.n_id;
    return depth != o.depth ? depth > o.depth : number < o.number;
  }
};

SentPair sent(const WorstPair& p) {
  if (p.ids.empty()) return {};
  return {p.depth_um, p.number, 2, {p.ids[0], p.ids[1]}};
}

/// Replaces the results of this process by those of all.
void find_worst_of_all(const Ranks& ranks, AuditResult& r) {
  const std::array<WorstPair*, 9> pair{
      &r.dcm_dcm, &r.dcm_vessel, &r.dcm_wall, &r.dcm_cbm,         &r.dcm_cbm_beyond_indentation,
      &r.cbm_cbm, &r.cbm_vessel, &r.cbm_wall, &r.center_in_static};
  std::vector<SentPair> own, all;
  for (const WorstPair* p : pair) own.push_back(sent(*p));
  const bool meshes = r.worst_triangle_cell >= 0;
  own.push_back({-r.min_triangle_quality,
                 r.worst_triangle_number,
                 meshes ? 1 : 0,
                 {r.worst_triangle_cell, 0}});
  const std::size_t n = own.size();
  ranks.gather<SentPair>(own, all);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].is_worse_than(own[k % n])) own[k % n] = all[k];
  for (std::size_t k = 0; k < pair.size(); ++k)
    if (own[k].n_id > 0) *pair[k] = {own[k].depth, {own[k].id[0], own[k].id[1]}, own[k].number};
  if (const SentPair& flattest = own.back(); flattest.n_id > 0) {
    r.min_triangle_quality = -flattest.depth;
    r.worst_triangle_cell = flattest.id[0];
    r.worst_triangle_number = flattest.number;
  }
  std::array<double, 2> most{r.max_penetration_um, r.max_penetration_grown_um};
  ranks.max(most);
  std::tie(r.max_penetration_um, r.max_penetration_grown_um) = std::tie(most[0], most[1]);
  const std::array<int, 2> count{r.n_inverted, r.n_self_intersecting};
  std::vector<int> counts;
  ranks.gather<int>(count, counts);
  r.n_inverted = r.n_self_intersecting = 0;
  for (std::size_t k = 0; k < counts.size(); k += 2) {
    r.n_inverted += counts[k];
    r.n_self_intersecting += counts[k + 1];
  }
}

}  // namespace

geometry::AuditBody prepare_static_mesh(std::span<const Vec3> node,
                                        std::span<const std::array<int, 3>> triangle,
                                        const std::string& what) {
  check_finite(node, what);
  geometry::AuditBody prepared(node, triangle);
  check(prepared.closed(), fmt::format("audit: {} is not closed", what));
  return prepared;
}

AuditResult audit(const AuditFrame& frame, const Ranks& ranks) {
  AuditResult result;
  const Bodies bodies = prepare(frame);
  const std::vector<AuditQuery> query = find_queries(frame, bodies, result);
  const std::vector<AuditAnswer> answer = answer_queries(frame, bodies.cell, bodies.cone, query);
  for (std::size_t k = 0; k < query.size(); ++k) keep(frame, bodies, query[k], answer[k], result);
  audit_vessel_surface(frame, result);
  audit_spheres_at_walls(frame, result);
  if (!ranks.is_alone()) find_worst_of_all(ranks, result);
  result.max_overlap_cbm_um = result.cbm_cbm.depth_um;
  return result;
}

}  // namespace acinus::coupling
