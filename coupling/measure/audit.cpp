#include "coupling/measure/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/measure/audit_depth.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::coupling {
namespace {

/// Least distance of sisters, in radii of cells about to divide: they are born 2 (R_m - R_d) apart
/// (cbm::divide) and grow in place.
const double kSisterDistance = 2 - std::cbrt(4.0);

double sphere_depth(const geometry::AuditBody& cell, const AuditSphere& sphere) {
  const double distance = cell.distance(sphere.center);
  const double sign = cell.locate(sphere.center) == geometry::Location::kInside ? 1 : -1;
  return sphere.radius + sign * distance;
}

void keep_worst(WorstPair& worst, double depth, std::int64_t a, std::int64_t b) {
  if (depth > worst.depth_um) worst = {depth, {a, b}};
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

/// Bodies prepared for a frame.
struct Bodies {
  std::vector<geometry::AuditBody> cell;
  std::vector<RoundCone> cone;
};

Bodies prepare(const AuditFrame& frame) {
  for (const AuditMesh& m : frame.meshes) check_finite(m.node, fmt::format("cell {}", m.id));
  for (const AuditSphere& s : frame.spheres)
    check_finite(std::span(&s.center, 1), fmt::format("sphere {}", s.id));
  Bodies bodies;
  std::vector<std::optional<geometry::AuditBody>> cell(frame.meshes.size());
  for_each_part(cell.size(), [&](std::size_t c) {
    cell[c].emplace(frame.meshes[c].node, frame.meshes[c].triangle);
  });
  for (std::optional<geometry::AuditBody>& c : cell) bodies.cell.push_back(std::move(*c));
  if (!frame.vessels || frame.vessel_surface) return bodies;
  const geometry::Network& net = *frame.vessels;
  for (std::size_t s = 0; s < net.segment.size(); ++s)
    bodies.cone.push_back({net.node[net.segment[s][0]], net.node[net.segment[s][1]],
                           net.radius[s][0], net.radius[s][1]});
  return bodies;
}

/// Calls f(k) for all k < n, distributed over the processes, and gathers the results in all.
template <class T, class F>
std::vector<T> share_among(const Ranks& ranks, std::size_t n, const F& f) {
  const auto n_rank = static_cast<std::size_t>(ranks.size()),
             rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t first = rank * n / n_rank, last = (rank + 1) * n / n_rank;
  std::vector<T> own(last - first), all;
  for_each_part(own.size(), [&](std::size_t k) { own[k] = f(first + k); });
  ranks.gather<T>(own, all);
  return all;
}

void audit_shapes(const AuditFrame& frame, const Bodies& bodies, const Ranks& ranks,
                  AuditResult& result) {
  const std::vector<char> crosses = share_among<char>(
      ranks, bodies.cell.size(),
      [&](std::size_t c) { return static_cast<char>(bodies.cell[c].self_intersects()); });
  for (std::size_t c = 0; c < bodies.cell.size(); ++c) {
    const geometry::AuditBody& cell = bodies.cell[c];
    result.n_inverted += cell.volume <= 0;
    result.n_self_intersecting += crosses[c];
    if (cell.quality < result.min_triangle_quality || result.worst_triangle_cell < 0) {
      result.min_triangle_quality = cell.quality;
      result.worst_triangle_cell = frame.meshes[c].id;
    }
  }
}

/// Walls and envelopes: every cell has to be on their allowed side, near or not.
void audit_walls(const AuditFrame& frame, const Bodies& bodies, AuditResult& result) {
  for (std::size_t c = 0; c < bodies.cell.size(); ++c) {
    const AuditMesh& cell = frame.meshes[c];
    std::int64_t wall = 0;
    const auto keep = [&](double depth) {
      keep_worst(result.dcm_wall, depth, cell.id, wall);
      keep_penetration(result, depth, cell.newborn);
    };
    for (const AuditWall& w : frame.walls) {
      for (const Vec3& x : cell.node) keep(depth_behind(w, x, 0));
      ++wall;
    }
    for (std::size_t f = 0; f < frame.static_meshes.size(); ++f, ++wall)
      if (frame.static_meshes[f].inside) {
        const geometry::AuditBody &body = bodies.cell[c], &fixed = frame.static_meshes[f].body;
        keep(surface_depth(body, fixed, geometry::Location::kOutside));
        keep(surface_depth(fixed, body, geometry::Location::kInside));
      }
  }
}

/// Depth of a sphere beyond the surface of a closed body on the forbidden side, um.
double depth_in_fixed(const AuditSphere& sphere, const geometry::AuditBody& fixed,
                      geometry::Location forbidden) {
  const double distance = fixed.distance(sphere.center);
  return sphere.radius + (fixed.locate(sphere.center) == forbidden ? distance : -distance);
}

void audit_spheres_at_walls(const AuditFrame& frame, AuditResult& result) {
  for (const AuditSphere& s : frame.spheres) {
    std::int64_t wall = 0;
    const auto keep = [&](double depth) { keep_worst(result.cbm_wall, depth, s.id, wall++); };
    for (const AuditWall& w : frame.walls) keep(depth_behind(w, s.center, s.radius));
    for (std::size_t f = 0; f < frame.static_meshes.size(); ++f) {
      const double depth =
          depth_in_fixed(s, frame.static_meshes[f].body,
                         frame.static_meshes[f].inside ? geometry::Location::kOutside
                                                       : geometry::Location::kInside);
      keep(depth);
      keep_worst(result.center_in_static, depth - s.radius, s.id, static_cast<std::int64_t>(f));
    }
  }
}

/// Cells and spheres at the surface of the vessels.
void audit_vessel_surface(const AuditFrame& frame, const Bodies& bodies, const Ranks& ranks,
                          AuditResult& result) {
  if (!frame.vessel_surface) return;
  const geometry::AuditBody& surface = *frame.vessel_surface;
  const std::size_t n_cell = bodies.cell.size();
  const std::vector<double> depth =
      share_among<double>(ranks, n_cell + frame.spheres.size(), [&](std::size_t k) {
        if (k < n_cell)
          return bodies.cell[k].box.overlaps(surface.box) ? body_depth(bodies.cell[k], surface) : 0;
        const AuditSphere& s = frame.spheres[k - n_cell];
        if (!surface.box.overlaps(sphere_box(s.center, s.radius))) return 0.0;
        return depth_in_fixed(s, surface, geometry::Location::kInside);
      });
  for (std::size_t k = 0; k < depth.size(); ++k) {
    const bool cell = k < n_cell;
    WorstPair& worst = cell ? result.dcm_vessel : result.cbm_vessel;
    if (cell) keep_penetration(result, depth[k], frame.meshes[k].newborn);
    if (depth[k] <= worst.depth_um) continue;
    const Vec3 at = cell ? Vec3(0.5 * (bodies.cell[k].box.low + bodies.cell[k].box.high))
                         : frame.spheres[k - n_cell].center;
    keep_worst(worst, depth[k], cell ? frame.meshes[k].id : frame.spheres[k - n_cell].id,
               geometry::nearest_segment(*frame.vessels, at).segment);
  }
}

struct Pair {
  enum class PairKind {
    kCellCell,
    kCellSphere,
    kCellVessel,
    kCellFixed,
    kSphereSphere,
    kSphereVessel
  } kind;
  std::size_t a, b;
  double depth = 0;
};

std::vector<Pair> find_pairs(const AuditFrame& frame, const Bodies& bodies) {
  std::vector<Box> box;
  for (const geometry::AuditBody& b : bodies.cell) box.push_back(b.box);
  for (const AuditSphere& s : frame.spheres) box.push_back(sphere_box(s.center, s.radius));
  for (const RoundCone& c : bodies.cone) box.push_back(c.box());
  for (const AuditStaticMesh& s : frame.static_meshes) box.push_back(s.body.box);
  const std::size_t sphere = bodies.cell.size(), cone = sphere + frame.spheres.size();
  const std::size_t fixed = cone + bodies.cone.size();
  std::vector<Pair> pair;
  for (const auto& [i, j] : geometry::meeting_boxes(box)) {  // i < j: the cell comes first
    const std::size_t a = i, b = j;
    if (a < sphere) {
      if (b < sphere)
        pair.push_back({Pair::PairKind::kCellCell, a, b});
      else if (b < cone)
        pair.push_back({Pair::PairKind::kCellSphere, a, b - sphere});
      else if (b < fixed)
        pair.push_back({Pair::PairKind::kCellVessel, a, b - cone});
      else if (!frame.static_meshes[b - fixed].inside)
        pair.push_back({Pair::PairKind::kCellFixed, a, b - fixed});
    } else if (a < cone && b < cone) {
      pair.push_back({Pair::PairKind::kSphereSphere, a - sphere, b - sphere});
    } else if (a < cone && b < fixed) {
      pair.push_back({Pair::PairKind::kSphereVessel, a - sphere, b - cone});
    }
  }
  return pair;
}

double sphere_overlap(const AuditSphere& a, const AuditSphere& b) {
  const double distance = (a.center - b.center).norm(), depth = a.radius + b.radius - distance;
  const bool sisters = a.mother >= 0 && a.mother == b.mother;
  if (!sisters || depth <= std::max(a.radius, b.radius)) return depth;
  const bool weak = a.strength < 1 || b.strength < 1;
  return weak || distance >= kSisterDistance * 0.5 * (a.radius + b.radius) ? 0 : depth;
}

double pair_depth(const AuditFrame& frame, const Bodies& bodies, const Pair& pair) {
  switch (pair.kind) {
    case Pair::PairKind::kCellCell:
      return body_depth(bodies.cell[pair.a], bodies.cell[pair.b]);
    case Pair::PairKind::kCellSphere:
      return sphere_depth(bodies.cell[pair.a], frame.spheres[pair.b]);
    case Pair::PairKind::kCellVessel:
      return vessel_depth(bodies.cell[pair.a], bodies.cone[pair.b]);
    case Pair::PairKind::kCellFixed:
      return body_depth(bodies.cell[pair.a], frame.static_meshes[pair.b].body);
    case Pair::PairKind::kSphereSphere:
      return sphere_overlap(frame.spheres[pair.a], frame.spheres[pair.b]);
    case Pair::PairKind::kSphereVessel:
      return frame.spheres[pair.a].radius +
             cone_depth(bodies.cone[pair.b], frame.spheres[pair.a].center);
  }
  return 0;
}

void keep_pair(const AuditFrame& frame, const Pair& pair, AuditResult& result) {
  const auto other = static_cast<std::int64_t>(pair.b);
  const bool of_cell =
      pair.kind != Pair::PairKind::kSphereSphere && pair.kind != Pair::PairKind::kSphereVessel;
  const bool newborn = of_cell && frame.meshes[pair.a].newborn;
  switch (pair.kind) {
    case Pair::PairKind::kCellCell:
      keep_penetration(result, pair.depth, newborn || frame.meshes[pair.b].newborn);
      return keep_worst(result.dcm_dcm, pair.depth, frame.meshes[pair.a].id,
                        frame.meshes[pair.b].id);
    case Pair::PairKind::kCellSphere: {
      const std::int64_t mesh = frame.meshes[pair.a].id, sphere = frame.spheres[pair.b].id;
      const auto indentation = std::ranges::find_if(
          frame.indentations,
          [&](const KnownIndentation& d) { return d.mesh_id == mesh && d.sphere_id == sphere; });
      const double explained =
          indentation == frame.indentations.end() ? 0 : std::max(0.0, indentation->depth);
      const double beyond = std::max(0.0, pair.depth - explained);
      keep_penetration(result, beyond, newborn);
      keep_worst(result.dcm_cbm_beyond_indentation, beyond, mesh, sphere);
      return keep_worst(result.dcm_cbm, pair.depth, mesh, sphere);
    }
    case Pair::PairKind::kCellVessel:
      keep_penetration(result, pair.depth, newborn);
      return keep_worst(result.dcm_vessel, pair.depth, frame.meshes[pair.a].id, other);
    case Pair::PairKind::kCellFixed: {
      const auto before = static_cast<std::int64_t>(frame.walls.size());
      keep_penetration(result, pair.depth, newborn);
      return keep_worst(result.dcm_wall, pair.depth, frame.meshes[pair.a].id, before + other);
    }
    case Pair::PairKind::kSphereSphere:
      return keep_worst(result.cbm_cbm, pair.depth, frame.spheres[pair.a].id,
                        frame.spheres[pair.b].id);
    case Pair::PairKind::kSphereVessel:
      return keep_worst(result.cbm_vessel, pair.depth, frame.spheres[pair.a].id, other);
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
  audit_shapes(frame, bodies, ranks, result);
  audit_walls(frame, bodies, result);
  audit_vessel_surface(frame, bodies, ranks, result);
  audit_spheres_at_walls(frame, result);
  std::vector<Pair> pairs = find_pairs(frame, bodies);
  const std::vector<double> depth = share_among<double>(
      ranks, pairs.size(), [&](std::size_t k) { return pair_depth(frame, bodies, pairs[k]); });
  for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k].depth = depth[k];
  for (const Pair& pair : pairs)
    keep_pair(frame, pair, result);  // in list order, whoever computed it
  result.max_overlap_cbm_um = result.cbm_cbm.depth_um;
  return result;
}

}  // namespace acinus::coupling
