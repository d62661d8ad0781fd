#include "dcm/state.hpp"

#include <algorithm>

#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "dcm/mesh_pattern.hpp"

namespace acinus::dcm {

namespace {

/// Sets the points of a cell to the images under f of those of the unit cell at rest.
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
  /// Lane for one more cell, in a new group if need be.
  std::size_t add(std::int64_t lineage, const Group& like) {
    const std::size_t lane = find_lane(like);
    lineage_[lane] = lineage;
    return lane;
  }

  /// State with these groups, at rest in empty lanes; points of cells are left to place.
  State make_state() && {
    State s;
    s.group = std::move(group_);
    s.lineage = std::move(lineage_);
    const std::size_t n = s.n_lane();
    s.volume.resize(n, Ramp::constant(4.0 / 3 * kPi));
    s.birth.resize(n);
    s.tension.resize(n);
    s.pull.resize(n, Vec3::Zero());
    s.position = make_zeros<double>(n_row_ * kPointStride);
    for_each_index(n, worth_threads(n_row_), [&](std::size_t l) {
      if (!s.active(l)) place_points(s, l, [](const Vec3& x) { return x; });
    });
    return s;
  }

 private:
  std::size_t find_lane(const Group& like) {
    for (auto& [group, lane] : open_) {
      const Group& g = group_[group];
      if (g.type == like.type && g.topology == like.topology && g.nucleus == like.nucleus) {
        if (lane % kLanes != 0) return lane++;
        group = group_.size();
        lane = open_group(like);
        return lane++;
      }
    }
    open_.emplace_back(group_.size(), 0);
    open_.back().second = open_group(like);
    return open_.back().second++;
  }
  std::size_t open_group(const Group& like) {
    const std::size_t lane = lineage_.size();
    group_.push_back({like.topology, n_row_, like.type, like.nucleus});
    lineage_.resize(lane + kLanes, kEmptyLane);
    n_row_ += static_cast<std::size_t>(like.n_point());
    return lane;
  }
  std::vector<Group> group_;
  std::vector<std::int64_t> lineage_;
  std::size_t n_row_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> open_;  ///< (group, its next lane)
};

}  // namespace

State make_state(const std::vector<NewCell>& cells) {
  Grouping grouping;
  std::vector<std::size_t> lane;
  for (const NewCell& c : cells)
    lane.push_back(grouping.add(c.lineage, {c.topology, 0, c.type, c.nucleus}));
  State s = std::move(grouping).make_state();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const NewCell& c = cells[k];
    s.volume[lane[k]] = Ramp::constant(4.0 / 3 * kPi * c.radius * c.radius * c.radius);
    s.pull[lane[k]] = c.pull;
    place_points(s, lane[k],
                 [&c](const Vec3& x) -> Vec3 { return c.center + c.radius * (c.rotation * x); });
  }
  return s;
}

State compose(std::span<const SelectedCell<State>> cells, std::vector<std::size_t>& lane,
              std::span<const std::uint8_t> absent) {
  Grouping grouping;
  lane.clear();
  for (const SelectedCell<State>& c : cells) {
    const Group& g = c.state->group[c.index / kLanes];
    lane.push_back(grouping.add(c.state->lineage[c.index],
                                {g.topology, 0, c.type < 0 ? g.type : c.type, g.nucleus}));
  }
  State s = std::move(grouping).make_state();
  for_each_index(cells.size(), worth_threads(s.n_row()), [&](std::size_t k) {
    const State& from = *cells[k].state;
    const std::size_t at = cells[k].index, to = lane[k];
    s.volume[to] = from.volume[at];
    s.birth[to] = from.birth[at];
    s.tension[to] = from.tension[at];
    s.pull[to] = from.pull[at];
    if (!absent.empty() && absent[k] != 0) return;
    for (int i = 0; i < from.group[at / kLanes].n_point(); ++i)
      store_point(s.position.data(), node_address(s, to, i),
                  load_point(from.position.data(), node_address(from, at, i)));
  });
  return s;
}

int count_cells(const State& s) {
  return static_cast<int>(
      std::ranges::count_if(s.lineage, [](std::int64_t id) { return id != kEmptyLane; }));
}

std::vector<double> reference_radii(const State& s, double time) {
  std::vector<double> radius;
  refresh_reference_radii(s, time, radius);
  return radius;
}

void refresh_reference_radii(const State& s, double time, std::vector<double>& radius) {
  radius.assign(s.n_lane(), 1.0);
  for (std::size_t l = 0; l < radius.size(); ++l)
    if (s.active(l)) radius[l] = sphere_radius(s.volume[l].at(time));
}

Vec3 cell_center(const State& s, std::size_t lane) {
  const geometry::Topology& t = *s.group[lane / kLanes].topology;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < t.n_node; ++i)
    sum += t.rest_node_area[i] * load_point(s.position.data(), node_address(s, lane, i));
  return sum / t.rest_area;
}

void scale_cell(double factor, std::size_t lane, State& s) {
  const Vec3 center = cell_center(s, lane);
  for (int i = 0; i < s.group[lane / kLanes].n_point(); ++i) {
    const Address a = node_address(s, lane, i);
    store_point(s.position.data(), a,
                center + factor * (load_point(s.position.data(), a) - center));
  }
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
