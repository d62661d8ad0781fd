#include "dcm/state.hpp"

#include <algorithm>
#include <cmath>

#include "dcm/mesh_pattern.hpp"

namespace acinus::dcm {

State make_state(const std::vector<NewCell>& cells) {
  State s;
  std::size_t rows = 0;
  // Stable grouping: a group is open while it has a free lane and its type and topology match.
  auto open_group = [&](const NewCell& c) -> std::size_t {
    for (std::size_t g = 0; g < s.group.size(); ++g)
      if (s.group[g].type == c.type && s.group[g].topology == c.topology)
        for (std::size_t l = g * kLanes; l < (g + 1) * kLanes; ++l)
          if (s.lineage[l] == kEmptyLane) return l;
    s.group.push_back({c.topology, rows, c.type});
    rows += static_cast<std::size_t>(c.topology->n_node);
    const std::size_t n = s.group.size() * kLanes;
    s.lineage.resize(n, kEmptyLane);
    s.volume.resize(n, Ramp::constant(4.0 / 3 * kPi));
    s.pull.resize(n, Vec3::Zero());
    s.position.resize(rows * kPointStride, 0.0);
    for (std::size_t l = n - kLanes; l < n; ++l)
      for (int i = 0; i < c.topology->n_node; ++i)
        store_point(s.position.data(), node_address(s, l, i),
                    c.topology->rest[static_cast<std::size_t>(i)]);
    return n - kLanes;
  };
  for (const NewCell& c : cells) {
    const std::size_t lane = open_group(c);
    s.lineage[lane] = c.lineage;
    s.volume[lane] = Ramp::constant(4.0 / 3 * kPi * c.radius * c.radius * c.radius);
    s.pull[lane] = c.pull;
    for (int i = 0; i < c.topology->n_node; ++i)
      store_point(
          s.position.data(), node_address(s, lane, i),
          c.center + c.radius * (c.rotation * c.topology->rest[static_cast<std::size_t>(i)]));
  }
  return s;
}

int count_cells(const State& s) {
  return static_cast<int>(
      std::ranges::count_if(s.lineage, [](std::int64_t id) { return id != kEmptyLane; }));
}

std::vector<double> reference_radii(const State& s, double time) {
  std::vector<double> r(s.n_lane(), 1.0);
  for (std::size_t l = 0; l < r.size(); ++l)
    if (s.active(l)) r[l] = std::cbrt(s.volume[l].at(time) / (4.0 / 3 * kPi));
  return r;
}

Vec3 cell_center(const State& s, std::size_t lane) {
  const mesh::Topology& t = *s.group[lane / kLanes].topology;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < t.n_node; ++i)
    sum += t.rest_node_area[static_cast<std::size_t>(i)] *
           load_point(s.position.data(), node_address(s, lane, i));
  return sum / t.rest_area;
}

void copy_nodes(const State& s, std::size_t lane, std::vector<Vec3>& node) {
  const int n = s.group[lane / kLanes].topology->n_node;
  node.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    node[static_cast<std::size_t>(i)] = load_point(s.position.data(), node_address(s, lane, i));
}

std::vector<solve::Block> make_blocks(const State& s, std::span<const Params> params) {
  std::vector<solve::Block> blocks;
  for (const Group& g : s.group) {
    solve::Block block;
    block.pattern = &shared_mesh_pattern(*g.topology, params[static_cast<std::size_t>(g.type)]);
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace acinus::dcm
