#include "dcm/contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/threads.hpp"
#include "dcm/vessel_wall.hpp"

namespace acinus::dcm {
namespace {

using contact::SurroundingKind;

contact::SearchOptions search_options(const ContactParams& c, const State& state,
                                      const LaneData& lanes) {
  double range = 0;
  for (std::size_t l = 0; l < state.n_lane(); ++l)
    if (state.active(l))
      range = std::max(range, contact_range(c, *state.group[l / kLanes].topology, lanes.radius[l]));
  return {c.quadrature, range, c.max_depth, c.skin, 2 * kSelfGap};
}

/// Gives the contacts of a body with vessels, from `first` on, the stiffness that follows from the
/// deepest of them with the same segment, and adds those that push where the wall yields no more.
void set_wall_stiffness(const ContactParams& c, const contact::Material& wall, std::size_t first,
                        std::vector<ObstacleContact>& out) {
  std::map<int, double> deepest;
  for (const ObstacleContact& o : std::span(out).subspan(first)) {
    double& depth = deepest.try_emplace(o.index, 0.0).first->second;
    depth = std::max(depth, -o.gap);
  }
  for (std::size_t k = first, n = out.size(); k < n; ++k) {
    ObstacleContact& o = out[k];
    // No deeper than contacts are looked for, with room for what pushes behind it.
    const double limit = std::min(yield_limit(wall, o.radius), c.max_depth / 2);
    const double k_bed = wall_stiffness(c.repulsion, wall, o.radius, deepest[o.index]);
    if (o.guard) {
      o.stiffness = c.repulsion;
      o.onset = kGuardGap + (1 - k_bed / c.repulsion) * limit;
      continue;
    }
    o.stiffness = k_bed;
    // There before it pushes, as it may come to within a step.
    if (limit == 0 || -o.gap < limit / 2) continue;
    ObstacleContact stop = o;
    stop.stiffness = c.repulsion - o.stiffness;
    stop.onset = limit;
    out.push_back(stop);
  }
}

/// Contacts of one body with the vessels, one per point: the nearest segment of the network.
void find_vessel_contacts(const contact::SurfaceBody& b, int number, const ContactParams& c,
                          double range, const SegmentCandidates& list,
                          const contact::Vessels& vessels, std::vector<ObstacleContact>& out) {
  const mesh::Network& network = vessels.network;
  const std::size_t first = out.size();
  const int per_site = contact::points_per_site(c.quadrature);
  auto nearest = [&](std::size_t site, int p, bool guard, const Vec3& x) {
    ObstacleContact best{number, p, SurroundingKind::kVessel, -1, range, {}, guard};
    for (std::uint32_t e = list.start[site]; e < list.start[site + 1]; ++e) {
      const contact::Gap g = contact::gap_to_segment(network, list.segment[e], x);
      if (g.gap >= best.gap) continue;
      best.index = list.segment[e];
      best.gap = g.gap;
      best.normal = g.normal;
      best.radius = g.radius;
    }
    return best;
  };
  for (std::size_t s = 0; s < list.site.size(); ++s)
    for (int q = 0; q < per_site; ++q) {
      const int p = list.site[s] * per_site + q;
      const ObstacleContact best = nearest(
          s, p, false, contact::point_position(b, contact::point_stencil(b, c.quadrature, p)));
      if (best.index >= 0) out.push_back(best);
    }
  // A node belongs to several faces; the deepest of what they see counts, once. Where the nodes are
  // points themselves only faces need a guard: a thin vessel could pass between the points.
  std::vector<ObstacleContact> guard(n_guards(b));
  auto look = [&](std::size_t s, int p) {
    ObstacleContact& held = guard[static_cast<std::size_t>(p)];
    const auto i = static_cast<std::size_t>(p);
    const Vec3& x = i < b.node.size() ? b.node[i] : b.center[i - b.node.size()];
    const ObstacleContact best = nearest(s, p, true, x);
    if (best.index >= 0 && best.gap < std::min(held.gap, -kGuardGap)) held = best;
  };
  const int n_node = static_cast<int>(b.node.size());
  if (contact::has_face_sites(c.quadrature)) {
    for (std::size_t s = 0; s < list.site.size(); ++s) {
      for (int p : (*b.triangle)[static_cast<std::size_t>(list.site[s])]) look(s, p);
      look(s, n_node + list.site[s]);
    }
  } else {
    std::vector<int> list_of_node(b.node.size(), -1);
    for (std::size_t s = 0; s < list.site.size() && list.site[s] < n_node; ++s)
      list_of_node[static_cast<std::size_t>(list.site[s])] = static_cast<int>(s);
    for (std::size_t f = 0; f < b.triangle->size(); ++f)
      for (int corner : (*b.triangle)[f])
        if (const int s = list_of_node[static_cast<std::size_t>(corner)]; s >= 0)
          look(static_cast<std::size_t>(s), n_node + static_cast<int>(f));
  }
  for (const ObstacleContact& o : guard)
    if (o.guard) out.push_back(o);
  set_wall_stiffness(c, vessels.material, first, out);
}

/// Contacts of one body with planes, capsules and vessels.
void find_obstacle_contacts(const contact::SurfaceBody& b, int number, const ContactParams& c,
                            double range, const contact::Surroundings& around, double time,
                            const SegmentCandidates& list, std::vector<ObstacleContact>& out) {
  const int n_point = static_cast<int>(contact::n_points(b, c.quadrature));
  const Vec3 middle = 0.5 * (b.box.low + b.box.high);
  const double half = 0.5 * (b.box.high - b.box.low).norm();
  auto probe = [&](SurroundingKind kind, std::size_t index, auto gap_of) {
    if (gap_of(middle).gap - half >= range) return;
    for (int p = 0; p < n_point; ++p) {
      const contact::Gap g =
          gap_of(contact::point_position(b, contact::point_stencil(b, c.quadrature, p)));
      if (g.gap < range)
        out.push_back(
            {number, p, kind, static_cast<int>(index), g.gap, g.normal, false, 0, c.repulsion, 0});
    }
  };
  for (std::size_t i = 0; i < around.planes.size(); ++i)
    probe(SurroundingKind::kPlane, i,
          [&](const Vec3& x) { return contact::gap_to_plane(around.planes[i], x, time); });
  for (std::size_t i = 0; i < around.capsules.size(); ++i)
    probe(SurroundingKind::kCapsule, i,
          [&](const Vec3& x) { return contact::gap_to_capsule(around.capsules[i], x, time); });
  if (!list.site.empty()) find_vessel_contacts(b, number, c, range, list, around.vessels, out);
}

/// Area on the unit rest shape that a point stands for.
///
/// Of a triangle, nodes and edge midpoints have a quarter to the nodes and three quarters to the
/// midpoints: what the node rule gives on the mesh whose every triangle is cut in four. All points
/// then weigh about the same (S/648 and S/640 with 162 nodes), so a crossing edge is pushed out as
/// hard as a node at the rim, and the error for a traction that bends is a quarter of the node
/// rule's. No share at the nodes would be exact for it, but then they could not push.
double rest_share(const mesh::Topology& t, contact::Quadrature q, int point) {
  constexpr double kNodeShare = 0.25, kMidpointShare = (1 - kNodeShare) / 3;
  const auto p = static_cast<std::size_t>(point), n_node = static_cast<std::size_t>(t.n_node);
  switch (q) {
    case contact::Quadrature::kThreePoint:
      return t.rest_triangle_area[p / 3] / 3;
    case contact::Quadrature::kNodes:
      return t.rest_node_area[p];
    case contact::Quadrature::kNodesAndEdges:
      break;
  }
  if (p < n_node) return kNodeShare * t.rest_node_area[p];
  double area = 0;
  for (int face : t.edge_triangle[p - n_node])
    area += kMidpointShare * t.rest_triangle_area[static_cast<std::size_t>(face)];
  return area;
}

/// How much of each point's area touches something.
void find_shares(const ContactParams& c, std::size_t n_row, ContactWorkspace& work) {
  work.share.resize(work.body.size());
#pragma omp parallel for schedule(static) if (worth_threads(n_row))
  for (std::size_t k = 0; k < work.body.size(); ++k) {
    std::vector<double>& share = work.share[k];
    const auto number = static_cast<int>(k);
    share.assign(contact::n_points(work.body[k], c.quadrature), 0.0);
    // Both kinds of contact come body by body.
    for (const contact::SurfaceContact& s :
         std::ranges::equal_range(work.surface, number, {}, &contact::SurfaceContact::body_a))
      if (s.body_a != s.body_b)
        share[static_cast<std::size_t>(s.point)] += contact::contact_share(s.gap, c.friction_range);
    for (const ObstacleContact& o :
         std::ranges::equal_range(work.obstacle, number, {}, &ObstacleContact::body))
      if (!o.only_pushes())
        share[static_cast<std::size_t>(o.point)] += contact::contact_share(o.gap, c.friction_range);
  }
}

}  // namespace

double contact_range(const ContactParams& c, const mesh::Topology& t, double radius) {
  return std::max(c.range_factor * t.mean_rest_length * radius, c.friction_range);
}

double point_area(const mesh::Topology& t, contact::Quadrature q, int point, double radius) {
  return rest_share(t, q, point) * radius * radius;
}

contact::PointStencil obstacle_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                       const ObstacleContact& o) {
  const int n_node = static_cast<int>(body.node.size());
  if (!o.guard) return contact::point_stencil(body, c.quadrature, o.point);
  if (o.point < n_node) return {1, {o.point, 0, 0}, {1, 0, 0}};
  constexpr double kThird = 1.0f / 3;
  return {3,
          (*body.triangle)[static_cast<std::size_t>(o.point - n_node)],
          {kThird, kThird, 1 - 2 * kThird}};
}

double guard_area(const mesh::Topology& t, int point, double radius) {
  const auto k = static_cast<std::size_t>(point), n_node = static_cast<std::size_t>(t.n_node);
  return kGuardShare * radius * radius *
         (k < n_node ? t.rest_node_area[k] : t.rest_triangle_area[k - n_node]);
}

void refresh_bodies(const State& state, ContactWorkspace& work) {
  std::size_t n = 0;
  for (std::size_t l = 0; l < state.n_lane(); ++l) n += state.active(l) ? 1 : 0;
  if (work.body.size() != n) {
    work.body.assign(n, {});
    work.lane_of_body.clear();
    for (std::size_t l = 0; l < state.n_lane(); ++l)
      if (state.active(l)) work.lane_of_body.push_back(l);
  }
#pragma omp parallel for schedule(static) if (worth_threads(state.n_row()))
  for (std::size_t k = 0; k < n; ++k) {
    contact::SurfaceBody& b = work.body[k];
    b.topology = state.group[work.lane_of_body[k] / kLanes].topology;
    b.triangle = &b.topology->triangle;
    copy_nodes(state, work.lane_of_body[k], b.node);
    contact::refresh_body(b);
  }
}

void refresh_lists(const State& state, const ContactParams& c, const LaneData& lanes,
                   const contact::Surroundings& around, ContactWorkspace& work) {
  std::vector<std::int64_t> lineage;
  std::vector<std::uint8_t> constrained;
  for (std::size_t lane : work.lane_of_body) {
    lineage.push_back(state.lineage[lane]);
    if (!work.constrained.empty()) constrained.push_back(work.constrained[lane]);
  }
  refresh_lists({work.body, work.fixed, lineage, constrained, around.vessels.network,
                 search_options(c, state, lanes)},
                work.lists);
}

void find_contacts(const State& state, const ContactParams& c, const LaneData& lanes,
                   const contact::Surroundings& around, double time, ContactWorkspace& work) {
  const contact::SearchOptions options = search_options(c, state, lanes);
  const std::vector<contact::Candidates>& pair = work.lists.pair;
  // Each thread takes a run of lists, the first one writes in place: order as with one thread.
  work.surface.clear();
  const std::size_t n_part = count_threads(state.n_row());
  work.found.resize(n_part - 1);
  std::int64_t listed = 0, seen = 0;
#pragma omp parallel for schedule(static, 1) reduction(+ : listed, seen) if (n_part > 1)
  for (std::size_t part = 0; part < n_part; ++part) {
    auto& found = part == 0 ? work.surface : work.found[part - 1];
    const std::size_t before = found.size();
    found.clear();
    found.reserve(before + before / 8);  // contacts change little: doubling would waste memory
    for (std::size_t k = part * pair.size() / n_part; k < (part + 1) * pair.size() / n_part; ++k) {
      if (pair[k].point.empty()) continue;
      listed += static_cast<std::int64_t>(pair[k].point.size());
      seen += static_cast<std::int64_t>(contact::find_contacts(
          pair[k], work.body, work.fixed, options, relative_motion(work.lists, k), found));
    }
  }
  work.searches += 1;
  work.points_listed += listed;
  work.points_seen += seen;
  for (const auto& f : work.found) work.surface.insert(work.surface.end(), f.begin(), f.end());

  std::vector<std::vector<ObstacleContact>> obstacle(work.body.size());
#pragma omp parallel for schedule(dynamic, 2) if (worth_threads(state.n_row()))
  for (std::size_t k = 0; k < work.body.size(); ++k)
    if (work.constrained.empty() || work.constrained[work.lane_of_body[k]] == 0)
      find_obstacle_contacts(work.body[k], static_cast<int>(k), c, options.range, around, time,
                             work.lists.segment[k], obstacle[k]);
  work.obstacle.clear();
  for (const auto& o : obstacle) work.obstacle.insert(work.obstacle.end(), o.begin(), o.end());
  find_shares(c, state.n_row(), work);
}

void compute_medium_areas(const State& state, const ContactParams& c, const LaneData& lanes,
                          const ContactWorkspace& work, std::vector<double>& medium_area) {
  medium_area.assign(state.n_row() * kLanes, 0.0);
#pragma omp parallel for schedule(static) if (worth_threads(state.n_row()))
  for (std::size_t k = 0; k < work.body.size(); ++k) {
    const std::size_t lane = work.lane_of_body[k];
    const contact::SurfaceBody& b = work.body[k];
    const std::size_t first = state.group[lane / kLanes].first_row;
    for (std::size_t p = 0; p < work.share[k].size(); ++p) {
      const double area =
          point_area(*b.topology, c.quadrature, static_cast<int>(p), lanes.radius[lane]) *
          (c.whole_medium_area ? 1.0 : 1 - std::min(1.0, work.share[k][p]));
      const contact::PointStencil s = contact::point_stencil(b, c.quadrature, static_cast<int>(p));
      for (int m = 0; m < s.n; ++m)
        medium_area[(first + static_cast<std::size_t>(s.node[static_cast<std::size_t>(m)])) *
                        kLanes +
                    lane % kLanes] += s.weight[static_cast<std::size_t>(m)] * area;
    }
  }
}

}  // namespace acinus::dcm
