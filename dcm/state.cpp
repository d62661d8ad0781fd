#include "dcm/state.hpp"

#include <algorithm>

#include "core/sphere.hpp"
#include "dcm/mesh_pattern.hpp"

namespace acinus::dcm {

namespace {

/// Puts the points of a cell where f puts those of the unit cell at rest.
template <class F>
void place_points(State& s, std::size_t lane, F f) {
  const Group& g = s.group[lane / kLanes];
  const int n = g.topology->n_node;
  for (int i = 0; i < n; ++i)
    store_point(s.position.data(), node_address(s, lane, i), f(g.topology->rest[i]));
  for (int i = 0; i < g.nucleus.n_node(); ++i)
    store_point(s.position.data(), node_address(s, lane, n + i),
                f(g.nucleus.size * g.nucleus.topology->rest[i]));
}

/// Stable grouping: a group is open while it has a free lane and its type and meshes match.
class Grouping {
 public:
  /// A free lane for one more cell, in a new group if need be.
  std::size_t add(State& s, const Group& like) {
    for (auto& [group, lane] : open_) {
      const Group& g = s.group[group];
      if (g.type == like.type && g.topology == like.topology && g.nucleus == like.nucleus) {
        if (lane % kLanes != 0) return lane++;
        group = s.group.size();
        lane = open_group(s, like);
        return lane++;
      }
    }
    open_.emplace_back(s.group.size(), 0);
    open_.back().second = open_group(s, like);
    return open_.back().second++;
  }

 private:
  static std::size_t open_group(State& s, const Group& like) {
    const std::size_t lane = s.n_lane(), first = s.n_row();
    s.group.push_back({like.topology, first, like.type, like.nucleus});
    const std::size_t n = lane + kLanes;
    s.lineage.resize(n, kEmptyLane);
    s.volume.resize(n, Ramp::constant(4.0 / 3 * kPi));
    s.birth.resize(n);
    s.tension.resize(n);
    s.pull.resize(n, Vec3::Zero());
    s.position.resize((first + like.n_point()) * kPointStride, 0.0);
    for (std::size_t l = lane; l < n; ++l) place_points(s, l, [](const Vec3& x) { return x; });
    return lane;
  }
  std::vector<std::pair<std::size_t, std::size_t>> open_;  ///< (group, its next lane)
};

}  // namespace

State make_state(const std::vector<NewCell>& cells) {
  State s;
  Grouping grouping;
  for (const NewCell& c : cells) {
    const std::size_t lane = grouping.add(s, {c.topology, 0, c.type, c.nucleus});
    s.lineage[lane] = c.lineage;
    s.volume[lane] = Ramp::constant(4.0 / 3 * kPi * c.radius * c.radius * c.radius);
    s.pull[lane] = c.pull;
    place_points(s, lane,
                 [&c](const Vec3& x) -> Vec3 { return c.center + c.radius * (c.rotation * x); });
  }
  return s;
}

State compose(std::span<const CellRef> cells, std::vector<std::size_t>& lane) {
  State s;
  Grouping grouping;
  lane.clear();
  for (const CellRef& c : cells) {
    const State& from = *c.state;
    const Group& g = from.group[c.lane / kLanes];
    const std::size_t to =
        grouping.add(s, {g.topology, 0, c.type < 0 ? g.type : c.type, g.nucleus});
    lane.push_back(to);
    s.lineage[to] = from.lineage[c.lane];
    s.volume[to] = from.volume[c.lane];
    s.birth[to] = from.birth[c.lane];
    s.tension[to] = from.tension[c.lane];
    s.pull[to] = from.pull[c.lane];
    for (int i = 0; i < g.n_point(); ++i)
      store_point(s.position.data(), node_address(s, to, i),
                  load_point(from.position.data(), node_address(from, c.lane, i)));
  }
  return s;
}

int count_cells(const State& s) {
  return static_cast<int>(
      std::ranges::count_if(s.lineage, [](std::int64_t id) { return id != kEmptyLane; }));
}

std::vector<double> reference_radii(const State& s, double time) {
  std::vector<double> radius;
  find_reference_radii(s, time, radius);
  return radius;
}

void find_reference_radii(const State& s, double time, std::vector<double>& radius) {
  radius.assign(s.n_lane(), 1.0);
  for (std::size_t l = 0; l < radius.size(); ++l)
    if (s.active(l)) radius[l] = sphere_radius(s.volume[l].at(time));
}

Vec3 cell_center(const State& s, std::size_t lane) {
  const mesh::Topology& t = *s.group[lane / kLanes].topology;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < t.n_node; ++i)
    sum += t.rest_node_area[i] * load_point(s.position.data(), node_address(s, lane, i));
  return sum / t.rest_area;
}

void copy_nodes(const State& s, std::size_t lane, std::vector<Vec3>& node) {
  const int n = s.group[lane / kLanes].topology->n_node;
  node.resize(n);
  for (int i = 0; i < n; ++i) node[i] = load_point(s.position.data(), node_address(s, lane, i));
}

void store_nodes(std::span<const Vec3> node, std::size_t lane, State& s) {
  for (std::size_t i = 0; i < node.size(); ++i)
    store_point(s.position.data(), node_address(s, lane, static_cast<int>(i)), node[i]);
}

void copy_nucleus(const State& s, std::size_t lane, std::vector<Vec3>& node) {
  const Group& g = s.group[lane / kLanes];
  node.resize(g.nucleus.n_node());
  for (int i = 0; i < g.nucleus.n_node(); ++i)
    node[i] = load_point(s.position.data(), node_address(s, lane, g.topology->n_node + i));
}

void store_nucleus(std::span<const Vec3> node, std::size_t lane, State& s) {
  const Group& g = s.group[lane / kLanes];
  for (int i = 0; i < g.nucleus.n_node(); ++i)
    store_point(s.position.data(), node_address(s, lane, g.topology->n_node + i), node[i]);
}

std::vector<solve::Block> make_blocks(const State& s, std::span<const Params> params,
                                      std::span<const std::uint8_t> constrained) {
  std::vector<solve::Block> blocks;
  for (std::size_t k = 0; k < s.group.size(); ++k) {
    const Group& g = s.group[k];
    solve::Block block;
    block.still = !constrained.empty();
    for (std::size_t l = k * kLanes; l < (k + 1) * kLanes && block.still; ++l)
      block.still = !s.active(l) || constrained[l] != 0;
    const Params& p = params[g.type];
    block.pattern = block.still ? &shared_point_pattern(g.n_point())
                                : &shared_mesh_pattern(*g.topology, p, g.nucleus);
    blocks.push_back(block);
  }
  set_dashpots(s, params, blocks);
  return blocks;
}

void set_dashpots(const State& s, std::span<const Params> params, std::span<solve::Block> block) {
  for (std::size_t k = 0; k < s.group.size(); ++k) {
    const Params& p = params[s.group[k].type];
    block[k].dashpot = p.nodal_friction;
    block[k].dashpot_across = p.friction_across;
  }
}

}  // namespace acinus::dcm
