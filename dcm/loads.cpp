#include "dcm/loads.hpp"

#include <algorithm>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/tensions.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/bending.hpp"
#include "dcm/terms/body_load.hpp"
#include "dcm/terms/cortex.hpp"
#include "dcm/terms/cortex_tension.hpp"
#include "dcm/terms/local_area.hpp"
#include "dcm/terms/medium.hpp"
#include "dcm/terms/nucleus_shell.hpp"
#include "dcm/terms/series_spring.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::dcm {
namespace {

bool any_volume(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.bulk_modulus > 0; });
}
bool any_area(std::span<const Params> params) {
  return std::ranges::any_of(params, [](const Params& p) { return p.area_modulus > 0; });
}
bool any_nucleus(std::span<const Params> params, double Nucleus::*modulus) {
  return std::ranges::any_of(
      params, [&](const Params& p) { return p.nucleus && (*p.nucleus).*modulus > 0; });
}

/// The rank-one families in their order in the system; null: no type needs it.
struct Families {
  solve::RankOne *volume = nullptr, *area = nullptr;
  solve::RankOne *nucleus_volume = nullptr, *nucleus_area = nullptr;
};
Families find_families(std::span<const Params> params, solve::System& s) {
  auto next = s.rank_one.begin();
  const auto take = [&](bool used) { return used ? &*next++ : nullptr; };
  Families f;
  f.volume = take(any_volume(params));
  f.area = take(any_area(params));
  f.nucleus_volume = take(any_nucleus(params, &Nucleus::bulk_modulus));
  f.nucleus_area = take(any_nucleus(params, &Nucleus::area_modulus));
  return f;
}

/// Ratios of one cell among those of its group.
void fill_lane(std::vector<double>& group, const std::vector<double>& ratio, double weight,
               std::size_t lane) {
  if (group.empty()) group.assign(ratio.size() * kLanes, 1.0);
  for (std::size_t k = 0; k < ratio.size(); ++k)
    group[k * kLanes + lane] = 1 + weight * (ratio[k] - 1);
}

/// Tensions of one cell among those of its group, of which others may not have any yet.
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

/// Sizes and links of nuclei.
void find_nucleus_lanes(const State& s, double time, LaneData& data) {
  NucleusLanes& n = data.nucleus;
  if (!has_nuclei(s)) {
    n = {};
    return;
  }
  n.radius.resize(s.n_lane());
  n.unit.assign(s.n_lane(), 1.0);
  n.link.resize(s.group.size());
  for (std::vector<double>& of_group : n.link) of_group.clear();
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    n.radius[l] = s.group[l / kLanes].nucleus.size * data.radius[l];
    const BirthShape& birth = s.birth[l];
    if (!birth.link.empty() && !birth.is_forgotten(time))
      fill_lane(n.link[l / kLanes], birth.link, birth.weight.at(time), l % kLanes);
  }
}

}  // namespace

LaneData make_lane_data(const State& state, double time) {
  LaneData data;
  find_lane_data(state, time, data);
  return data;
}

void find_lane_data(const State& state, double time, LaneData& data) {
  const std::size_t n = state.n_lane();
  find_reference_radii(state, time, data.radius);
  data.area.assign(n, 1.0);
  data.active.assign(n, 0.0);
  for (auto* factors : {&data.edge, &data.triangle, &data.tension, &data.length}) {
    factors->resize(state.group.size());
    for (std::vector<double>& of_group : *factors) of_group.clear();
  }
  for (std::size_t l = 0; l < n; ++l) {
    data.active[l] = state.active(l) ? 1.0 : 0.0;
    fill_tension(state, l, data);
    const BirthShape& birth = state.birth[l];
    if (birth.is_forgotten(time)) continue;
    const double weight = birth.weight.at(time);
    data.area[l] = 1 + weight * (birth.area - 1);
    fill_lane(data.edge[l / kLanes], birth.edge, weight, l % kLanes);
    fill_lane(data.triangle[l / kLanes], birth.triangle, weight, l % kLanes);
  }
  find_nucleus_lanes(state, time, data);
}

GroupView view_group(const State& state, const LaneData& lanes, const solve::System& s,
                     std::size_t k) {
  const Group& g = state.group[k];
  const solve::Block block = s.block.empty() ? solve::Block{} : s.block[k];
  return {g.topology,
          k,
          g.first_row,
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
  view.first_spring = block.first_spring + n_edge;
  view.first_hinge = block.first_hinge + n_edge;
  view.position = state.position.data() + view.first_row * kPointStride;
  view.radius = lanes.nucleus.radius.data() + k * kLanes;
  view.area = lanes.nucleus.unit.data() + k * kLanes;
  view.edge = view.triangle = view.tension = view.length = nullptr;
  return view;
}

void size_rank_one(const State& state, std::span<const Params> params, solve::System& s,
                   bool pull_springs) {
  s.rank_one.resize((any_volume(params) ? 1 : 0) + (any_area(params) ? 1 : 0) +
                    (any_nucleus(params, &Nucleus::bulk_modulus) ? 1 : 0) +
                    (any_nucleus(params, &Nucleus::area_modulus) ? 1 : 0) + (pull_springs ? 1 : 0));
  for (solve::RankOne& family : s.rank_one) {
    set_size(family.vector, state.position.size());
    set_size(family.coefficient, state.n_lane());
  }
}

void add_loads(const State& state, std::span<const Params> params, const LaneData& lanes,
               std::span<const double> medium_area, std::span<const Vec3> cell_force,
               solve::System& s) {
  const Families families = find_families(params, s);
  for_each_index(state.group.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    if (s.block[k].still || !s.ownership.owns(k)) return;
    const GroupView g = view_group(state, lanes, s, k);
    const Params& p = params[state.group[k].type];
    if (p.series_friction > 0)
      add_series_springs(p, g, s);
    else if (p.spring_stiffness > 0 || p.nodal_friction > 0)
      add_cortex(p, g, s);
    if (p.bending_stiffness > 0) add_bending(p, g, s);
    if (p.cortex_tension > 0) add_cortex_tension(p, g, s);
    if (p.local_area_modulus > 0) add_local_area(p, g, s);
    if (families.volume) add_volume(p, g, s, *families.volume);
    if (families.area) add_area(p, g, s, *families.area);
    add_medium(p, g, medium_area.data() + g.first_row * kLanes, s);
    add_body_load(g, cell_force.subspan(k * kLanes, kLanes), s);
    if (state.group[k].nucleus.exists())
      add_nucleus_shell(nucleus_shell(p), view_nuclei(state, lanes, s, k), families.nucleus_volume,
                        families.nucleus_area, s);
  });
}

void add_stretch_loads(const State& state, const LaneData& lanes, const StretchLoad& load,
                       solve::System& s) {
  for_each_index(state.group.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    if (!s.block[k].still && s.ownership.owns(k))
      add_stretch_load(view_group(state, lanes, s, k), load, s);
  });
}

void add_suction_loads(const State& state, const LaneData& lanes, const SuctionLoad& load,
                       solve::System& s) {
  for_each_index(state.group.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    if (!s.block[k].still && s.ownership.owns(k))
      add_suction_load(view_group(state, lanes, s, k), load, s);
  });
}

void add_pull_spring_loads(const State& state, const LaneData& lanes,
                           std::span<const PullSpring> spring, solve::System& s) {
  for (std::size_t k = 0; k < state.group.size(); ++k)
    if (!s.block[k].still && s.ownership.owns(k))
      add_pull_springs(view_group(state, lanes, s, k), spring.subspan(k * kLanes, kLanes), s,
                       s.rank_one.back());
}

std::vector<std::string> skipped_terms(std::span<const Params> params) {
  std::vector<std::string> skipped;
  auto unless = [&](const char* name, auto used) {
    if (std::ranges::none_of(params, used)) skipped.emplace_back(name);
  };
  unless("dcm cortex springs", [](const Params& p) { return p.spring_stiffness > 0; });
  unless("dcm nodal friction", [](const Params& p) { return p.nodal_friction > 0; });
  unless("dcm series dashpots", [](const Params& p) { return p.series_friction > 0; });
  unless("dcm bending", [](const Params& p) { return p.bending_stiffness > 0; });
  unless("dcm cortex tension", [](const Params& p) { return p.cortex_tension > 0; });
  unless("dcm volume", [](const Params& p) { return p.bulk_modulus > 0; });
  unless("dcm global area", [](const Params& p) { return p.area_modulus > 0; });
  unless("dcm local area", [](const Params& p) { return p.local_area_modulus > 0; });
  unless("dcm nucleus", [](const Params& p) { return p.nucleus.has_value(); });
  return skipped;
}

}  // namespace acinus::dcm
