#include "dcm/contact/contact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/obstacle_contacts.hpp"

namespace acinus::dcm {
namespace {

using contact::Contact;

contact::SearchOptions search_options(const ContactInput& in) {
  const ContactParams& c = in.options;
  const State& state = in.state;
  double range = 0;
  for (std::size_t l = 0; l < state.n_lane(); ++l)
    if (state.active(l))
      range =
          std::max(range, contact_range(c, *state.group[l / kLanes].topology, in.lanes.radius[l]));
  return {c.quadrature, range, c.max_depth, c.skin, 2 * kSelfGap};
}

/// Area on the unit rest shape that a point stands for.
///
/// Of a triangle, nodes and edge midpoints have a quarter to the nodes and three quarters to the
/// midpoints: what the node rule gives on the mesh whose every triangle is cut in four. All points
/// then weigh about the same (S/648 and S/640 with 162 nodes), so a crossing edge is pushed out as
/// hard as a node at the rim, and the error for a traction that bends is a quarter of the node
/// rule's. No share at the nodes would be exact for it, but then they could not push.
double rest_share(const geometry::Topology& t, contact::Quadrature q, int point) {
  constexpr double kNodeShare = 0.25, kMidpointShare = (1 - kNodeShare) / 3;
  const std::size_t p = point, n_node = t.n_node;
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
  for (int face : t.edge_triangle[p - n_node]) area += kMidpointShare * t.rest_triangle_area[face];
  return area;
}

/// How much of each point's area touches something.
void find_shares(const ContactInput& in, const contact::ContactList& contacts,
                 ContactWorkspace& work) {
  const double range = in.options.friction_range;
  const bool points = in.options.law == ContactLaw::kCohesive;
  work.share.resize(work.body.size());
  for_each_index(work.body.size(), worth_threads(in.state.n_row()), [&](std::size_t k) {
    std::vector<double>& share = work.share[k];
    if (work.is_complete[k] == 0) return share.clear();
    const auto number = static_cast<int>(k);
    share.assign(contact::n_points(work.body[k], in.options.quadrature), 0.0);
    for (const Contact& s : std::ranges::equal_range(
             points ? contacts.surface() : std::span<const Contact>{}, number, {}, &Contact::a))
      if (!s.is_fold()) share[s.point] += contact::contact_share(s.gap, range);
    for (const Contact& o : std::ranges::equal_range(contacts.obstacle(), number, {}, &Contact::a))
      if (!o.only_pushes()) share[o.point] += contact::contact_share(o.gap, range);
  });
  if (!points) add_triangle_shares(contacts, work);
}

void append(const std::vector<Contact>& more, std::vector<Contact>& all) {
  make_room(all, more.size());
  all.insert(all.end(), more.begin(), more.end());
}

/// Contacts of surfaces with each other and with static meshes, seen from the points.
void find_point_contacts(const ContactInput& in, const contact::SearchOptions& options,
                         ContactWorkspace& work, std::vector<Contact>& all) {
  const std::vector<contact::Candidates>& pair = work.lists.pair;
  // Each thread takes a run of lists, the first one writes in place: order as with one thread.
  const std::size_t n_part = count_threads(in.state.n_row());
  work.found.resize(n_part - 1);
  std::atomic<std::int64_t> listed = 0, seen = 0;
  for_each_part(n_part, [&](std::size_t part) {
    auto& found = part == 0 ? all : work.found[part - 1];
    const std::size_t before = found.size();
    found.clear();
    make_room(found, before);
    for (std::size_t k = part * pair.size() / n_part; k < (part + 1) * pair.size() / n_part; ++k) {
      if (pair[k].point.empty()) continue;
      make_room(found, pair[k].point.size());
      listed += static_cast<std::int64_t>(pair[k].point.size());
      seen += static_cast<std::int64_t>(contact::find_contacts(
          pair[k], work.body, work.fixed, options, relative_motion(work.lists, k), found));
    }
  });
  work.searches += 1;
  work.points_listed += listed;
  work.points_seen += seen;
  for (const auto& f : work.found) append(f, all);
}

}  // namespace

double contact_range(const ContactParams& c, const geometry::Topology& t, double radius) {
  return std::max(c.range_factor * t.mean_rest_length * radius, c.friction_range);
}

double point_area(const geometry::Topology& t, contact::Quadrature q, int point, double radius) {
  return rest_share(t, q, point) * radius * radius;
}

double point_stretch(const contact::SurfaceBody& b, contact::Quadrature q, int point,
                     double radius) {
  const geometry::Topology& t = *b.topology;
  double present = 0, rest = 0;
  const auto count = [&](int triangle) {
    const auto& [i, j, k] = (*b.triangle)[triangle];
    present += 0.5 * (b.node[j] - b.node[i]).cross(b.node[k] - b.node[i]).norm();
    rest += t.rest_triangle_area[triangle];
  };
  if (contact::has_face_sites(q)) {
    count(point / 3);
  } else if (point < t.n_node) {
    for (int f = t.node_triangle_start[point]; f < t.node_triangle_start[point + 1]; ++f)
      count(t.node_triangle[f]);
  } else {
    for (int triangle : t.edge_triangle[point - t.n_node]) count(triangle);
  }
  return present / (rest * radius * radius);
}

contact::PointStencil stencil_of(const ContactParams& c, const contact::SurfaceBody& body,
                                 const Contact& o) {
  if (is_between_triangles(c, o))
    return {3, (*body.triangle)[o.point], Contact::weights_at(o.place_a())};
  return probe_stencil(c, body, o);
}

contact::PointStencil probe_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                    const Contact& o) {
  const int n_node = static_cast<int>(body.node.size());
  if (!o.guard) return contact::point_stencil(body, c.quadrature, o.point);
  if (o.point < n_node) return {1, {o.point, 0, 0}, {1, 0, 0}};
  constexpr double kThird = 1.0f / 3;
  return {3, (*body.triangle)[o.point - n_node], {kThird, kThird, 1 - 2 * kThird}};
}

double guard_area(const geometry::Topology& t, int point, double radius) {
  const std::size_t k = point, n_node = t.n_node;
  return kGuardShare * radius * radius *
         (k < n_node ? t.rest_node_area[k] : t.rest_triangle_area[k - n_node]);
}

void refresh_lists(const ContactInput& in, ContactWorkspace& work) {
  work.lineage_of_body.clear();
  work.body_constrained.clear();
  work.body_foreign.clear();
  for (std::size_t lane : work.lane_of_body) {
    work.lineage_of_body.push_back(in.state.lineage[lane]);
    if (!work.constrained.empty()) work.body_constrained.push_back(work.constrained[lane]);
    if (!work.foreign.empty()) work.body_foreign.push_back(work.foreign[lane]);
  }
  const ListInput input{work.body,
                        work.fixed,
                        work.lineage_of_body,
                        work.body_constrained,
                        work.body_foreign,
                        in.boundary.vessels.network,
                        search_options(in),
                        in.vessel_row != contact::kAtRest};
  refresh_pairs(input, work.lists);
  if (!work.foreign.empty()) {
    std::vector<int> listed;
    for (const contact::Candidates& c : work.lists.pair)
      for (const int b : {c.body_a, c.body_b})
        if (b < static_cast<int>(work.body.size())) listed.push_back(b);
    complete_bodies(in.state, listed, work);
  }
  refresh_lists(input, work.lists);
}

void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts) {
  const contact::SearchOptions options = search_options(in);
  std::vector<Contact>& all = contacts.all;
  if (in.options.law == ContactLaw::kMaugisDugdale)
    find_triangle_contacts(in, work, all);
  else
    find_point_contacts(in, options, work, all);
  take_wall_contacts(in, work, all);
  contacts.surface_end = all.size();

  work.obstacle.resize(work.body.size());
  for_each_index(work.body.size(), worth_threads(in.state.n_row()), [&](std::size_t k) {
    work.obstacle[k].clear();
    const std::size_t lane = work.lane_of_body[k];
    if ((work.constrained.empty() || work.constrained[lane] == 0) && !work.is_foreign(lane))
      find_obstacle_contacts(in, work, static_cast<int>(k), options.range, work.obstacle[k]);
  });
  for (const auto& o : work.obstacle) append(o, all);
  contacts.obstacle_end = contacts.interface_end = contacts.sphere_obstacle_end = all.size();
  find_shares(in, contacts, work);
}

void compute_medium_areas(const ContactInput& in, const ContactWorkspace& work,
                          std::vector<double>& medium_area) {
  const State& state = in.state;
  const ContactParams& c = in.options;
  medium_area.assign(state.n_row() * kLanes, 0.0);
  for_each_index(work.body.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    const std::size_t lane = work.lane_of_body[k];
    if (work.is_foreign(lane)) return;
    const contact::SurfaceBody& b = work.body[k];
    const std::size_t first = state.group[lane / kLanes].first_row;
    for (std::size_t p = 0; p < work.share[k].size(); ++p) {
      const double area =
          point_area(*b.topology, c.quadrature, static_cast<int>(p), in.lanes.radius[lane]) *
          (c.whole_medium_area ? 1.0 : 1 - std::min(1.0, work.share[k][p]));
      const contact::PointStencil s = contact::point_stencil(b, c.quadrature, static_cast<int>(p));
      for (int m = 0; m < s.n; ++m)
        medium_area[(first + s.node[m]) * kLanes + lane % kLanes] += s.weight[m] * area;
    }
  });
}

}  // namespace acinus::dcm
