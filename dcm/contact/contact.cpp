#include "dcm/contact/contact.hpp"

#include <algorithm>
#include <atomic>

#include "contact/cohesive.hpp"
#include "core/parallel/append_in_order.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/obstacle_contacts.hpp"
#include "dcm/contact/triangle_contact.hpp"

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
  const bool triangles = c.law == ContactLaw::kMaugisDugdale;
  if (triangles) range = triangle_reach(in);
  return {c.quadrature, range, c.max_depth, c.skin, 2 * kSelfGap, triangles};
}

/// Touching share of each point, summed over its contacts.
void compute_shares(const ContactInput& in, const contact::ContactList& contacts,
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
    for (const Contact& o : std::ranges::equal_range(
             points ? contacts.obstacle() : std::span<const Contact>{}, number, {}, &Contact::a))
      if (!o.only_pushes()) share[o.point] += contact::contact_share(o.gap, range);
  });
  if (points) return;
  add_triangle_shares(contacts.surface(), work);
  add_triangle_shares(contacts.obstacle(), work);
}

/// Search for contacts of the points of surfaces with other surfaces and with static meshes.
void find_point_contacts(const ContactInput& in, const contact::SearchOptions& options,
                         ContactWorkspace& work, contact::Contacts& all) {
  const std::vector<contact::Candidates>& pair = work.lists.pair;
  std::atomic<std::int64_t> listed = 0, seen = 0;
  clear_to_refill(all);
  append_in_order(
      pair.size(), worth_threads(in.state.n_row()), all,
      [&](std::size_t k, contact::Contacts& found) {
        const std::size_t n = pair[k].list.n_point();
        if (n == 0) return;
        make_room(found, n);
        listed += static_cast<std::int64_t>(n);
        seen += static_cast<std::int64_t>(contact::find_contacts(
            pair[k], work.body, work.fixed, options, relative_motion(work.lists, k), found));
      });
  work.searches += 1;
  work.points_listed += listed;
  work.points_seen += seen;
}

}  // namespace

double contact_range(const ContactParams& c, const geometry::Topology& t, double radius) {
  return std::max(c.range_factor * t.mean_rest_length * radius, c.friction_range);
}

void refresh_lists(const ContactInput& in, ContactWorkspace& work) {
  work.lineage_of_body.clear();
  work.body_constrained.clear();
  work.body_ghost.clear();
  for (std::size_t lane : work.lane_of_body) {
    work.lineage_of_body.push_back(in.state.lineage[lane]);
    if (!work.constrained.empty()) work.body_constrained.push_back(work.constrained[lane]);
    if (!work.ghost.empty()) work.body_ghost.push_back(work.ghost[lane]);
  }
  const ListInput input{work.body,
                        work.fixed,
                        work.lineage_of_body,
                        work.body_constrained,
                        work.body_ghost,
                        in.boundary.vessels.network,
                        search_options(in),
                        in.vessel_row != contact::kAtRest};
  refresh_pairs(input, work.lists);
  if (!work.ghost.empty()) {
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
  contact::Contacts& all = contacts.all;
  const bool triangles = in.options.law == ContactLaw::kMaugisDugdale;
  if (triangles)
    find_triangle_contacts(in, work, options.range, all);
  else
    find_point_contacts(in, options, work, all);
  take_wall_contacts(in, work, all);
  contacts.close(contact::ContactKind::kSurface);

  append_in_order(
      work.body.size(), worth_threads(in.state.n_row()), all,
      [&](std::size_t k, contact::Contacts& found) {
        const std::size_t lane = work.lane_of_body[k];
        if ((work.constrained.empty() || work.constrained[lane] == 0) && !work.is_ghost(lane))
          triangles ? find_triangle_obstacles(in, work, static_cast<int>(k), options.range, found)
                    : find_obstacle_contacts(in, work, static_cast<int>(k), options.range, found);
      });
  contacts.close(contact::ContactKind::kObstacle);
  compute_shares(in, contacts, work);
}

void compute_medium_areas(const ContactInput& in, const ContactWorkspace& work,
                          RowVector<double>& medium_area) {
  const State& state = in.state;
  const ContactParams& c = in.options;
  set_size(medium_area, state.n_row() * kLanes);
  for_each_index(state.group.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    const Group& g = state.group[k];
    if (!work.is_ghost(k * kLanes))
      std::fill_n(medium_area.data() + g.first_row * kLanes,
                  static_cast<std::size_t>(g.n_point()) * kLanes, 0.0);
  });
  for_each_index(work.body.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    const std::size_t lane = work.lane_of_body[k];
    if (work.is_ghost(lane)) return;
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
