#include "dcm/lane_data.hpp"

#include "dcm/tensions.hpp"

namespace acinus::dcm {
namespace {

/// Ratios of one cell among those of its group.
void fill_lane(std::vector<double>& group, const SharedNumbers& ratio, double weight,
               std::size_t lane) {
  if (group.empty()) group.assign(ratio.size() * kLanes, 1.0);
  for (std::size_t k = 0; k < ratio.size(); ++k)
    group[k * kLanes + lane] = 1 + weight * (ratio[k] - 1);
}

/// Tensions of one cell among those of its group, other cells of which may have none yet.
void fill_tension(const State& s, std::size_t lane, LaneData& data) {
  const EdgeTension& t = s.tension[lane];
  if (t.is_new()) return;
  const std::size_t k = lane / kLanes, n = t.force.size();
  std::vector<double>&tension = data.tension[k], &length = data.length[k];
  if (tension.empty()) {
    tension.assign(n * kLanes, 0.0);
    length.resize(n * kLanes);
    for (std::size_t l = k * kLanes; l < (k + 1) * kLanes; ++l)
      for (std::size_t e = 0; e < n; ++e) length[e * kLanes + l % kLanes] = edge_length(s, l, e);
  }
  for (std::size_t e = 0; e < n; ++e) {
    tension[e * kLanes + lane % kLanes] = t.force[e];
    length[e * kLanes + lane % kLanes] = t.length[e];
  }
}

bool is_ghost(std::span<const std::uint8_t> ghost, std::size_t lane) {
  return !ghost.empty() && ghost[lane] != 0;
}

/// Removes the numbers of all groups, and their memory where the cells belong to other processes.
void clear_groups(std::span<const std::uint8_t> ghost, std::vector<std::vector<double>>& groups) {
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (is_ghost(ghost, k * kLanes))
      groups[k] = std::vector<double>();
    else
      groups[k].clear();
}

/// Sizes and links of nuclei.
void refresh_nucleus_lanes(const State& s, double time, LaneData& data,
                           std::span<const std::uint8_t> ghost) {
  NucleusLanes& n = data.nucleus;
  if (!has_nuclei(s)) {
    n = {};
    return;
  }
  n.radius.resize(s.n_lane());
  n.unit.assign(s.n_lane(), 1.0);
  n.link.resize(s.group.size());
  clear_groups(ghost, n.link);
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    n.radius[l] = s.group[l / kLanes].nucleus.size * data.radius[l];
    if (is_ghost(ghost, l)) continue;
    const BirthShape& birth = s.birth[l];
    if (!birth.link.empty() && !birth.is_forgotten(time))
      fill_lane(n.link[l / kLanes], birth.link, birth.weight.at(time), l % kLanes);
  }
}

}  // namespace

LaneData make_lane_data(const State& state, double time) {
  LaneData data;
  refresh_lane_data(state, time, data);
  return data;
}

void refresh_lane_data(const State& state, double time, LaneData& data,
                       std::span<const std::uint8_t> ghost) {
  const std::size_t n = state.n_lane();
  refresh_reference_radii(state, time, data.radius);
  data.area.assign(n, 1.0);
  data.active.assign(n, 0.0);
  for (auto* factors : {&data.edge, &data.triangle, &data.tension, &data.length}) {
    factors->resize(state.group.size());
    clear_groups(ghost, *factors);
  }
  for (std::size_t l = 0; l < n; ++l) {
    data.active[l] = state.active(l) ? 1.0 : 0.0;
    if (is_ghost(ghost, l)) continue;
    fill_tension(state, l, data);
    const BirthShape& birth = state.birth[l];
    if (birth.is_forgotten(time)) continue;
    const double weight = birth.weight.at(time);
    data.area[l] = 1 + weight * (birth.area - 1);
    fill_lane(data.edge[l / kLanes], birth.edge, weight, l % kLanes);
    fill_lane(data.triangle[l / kLanes], birth.triangle, weight, l % kLanes);
  }
  // Most groups have neither: birth shapes are soon forgotten.
  for (auto* factors : {&data.edge, &data.triangle, &data.tension, &data.length})
    for (std::vector<double>& of_group : *factors)
      if (of_group.empty()) of_group.shrink_to_fit();
  refresh_nucleus_lanes(state, time, data, ghost);
}

GroupView view_group(const State& state, const LaneData& lanes, const solve::System& s,
                     std::size_t k) {
  const Group& g = state.group[k];
  const solve::Block block = s.block.empty() ? solve::Block{} : s.block[k];
  return {g.topology,
          k,
          g.first_row,
          block.first_shape,
          block.first_spring,
          block.first_hinge,
          block.first_face,
          state.position.data() + g.first_row * kPointStride,
          lanes.radius.data() + k * kLanes,
          lanes.area.data() + k * kLanes,
          lanes.edge[k].empty() ? nullptr : lanes.edge[k].data(),
          lanes.triangle[k].empty() ? nullptr : lanes.triangle[k].data(),
          lanes.tension[k].empty() ? nullptr : lanes.tension[k].data(),
          lanes.length[k].empty() ? nullptr : lanes.length[k].data(),
          lanes.active.data() + k * kLanes};
}

GroupView view_nuclei(const State& state, const LaneData& lanes, const solve::System& s,
                      std::size_t k) {
  const Group& g = state.group[k];
  const solve::Block block = s.block.empty() ? solve::Block{} : s.block[k];
  const auto n_edge = static_cast<std::size_t>(g.topology->n_edge);
  GroupView view = view_group(state, lanes, s, k);
  view.topology = g.nucleus.topology;
  view.first_row = g.first_nucleus_row();
  view.first_shape = block.first_shape + static_cast<std::size_t>(g.topology->n_node);
  view.first_spring = block.first_spring + n_edge;
  view.first_hinge = block.first_hinge + n_edge;
  view.position = state.position.data() + view.first_row * kPointStride;
  view.radius = lanes.nucleus.radius.data() + k * kLanes;
  view.area = lanes.nucleus.unit.data() + k * kLanes;
  view.edge = view.triangle = view.tension = view.length = nullptr;
  return view;
}

}  // namespace acinus::dcm
