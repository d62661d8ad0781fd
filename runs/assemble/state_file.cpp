#include "runs/assemble/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "runs/assemble/state_numbers.hpp"
#include "runs/assemble/substance_file.hpp"
#include "runs/assemble/tree_file.hpp"

namespace acinus::runs {
namespace {

/// Converts a count of a file to int.
/// @throws Error(kFileError) if it is out of range
int as_int(const io::CheckpointData& d, const char* what, std::int64_t value) {
  check(value >= 0 && value <= std::numeric_limits<int>::max(),
        fmt::format("{}: {} holds {}, which cannot be. The file is damaged; resume from the "
                    "previous checkpoint or start anew.",
                    d.source(), what, value),
        Exit::kFileError);
  return static_cast<int>(value);
}

void get_birth_shapes(const io::CheckpointData& d, dcm::State& s) {
  s.birth.assign(s.n_lane(), {});
  const std::vector<double>& numbers = d.numbers("dcm/birth_shape");
  std::size_t at = 0;
  for (std::int64_t lane : d.integers("dcm/birth_lane")) {
    const std::size_t l = lane;
    check_same(d, "dcm/birth_lane", l < s.n_lane() ? 1 : 0, 1);
    const geometry::Topology& t = *s.group[l / kLanes].topology;
    const std::size_t n_edge = t.edge.size(), n_triangle = t.triangle.size();
    check_same(d, "dcm/birth_shape", numbers.size() >= at + 5 + n_edge + n_triangle ? 1 : 0, 1);
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(at);
    dcm::BirthShape& b = s.birth[l];
    b.weight = {from[0], from[1], from[2], from[3]};
    b.area = from[4];
    const auto edge = from + 5, triangle = edge + static_cast<std::ptrdiff_t>(n_edge);
    b.edge = std::vector<double>(edge, triangle);
    b.triangle = std::vector<double>(triangle, triangle + static_cast<std::ptrdiff_t>(n_triangle));
    at += 5 + n_edge + n_triangle;
  }
}

void get_tensions(const io::CheckpointData& d, dcm::State& s) {
  s.tension.assign(s.n_lane(), {});
  if (!d.contains("dcm/tension_lane")) return;  // written before there were any
  const std::vector<double>& numbers = d.numbers("dcm/tension");
  auto at = numbers.begin();
  for (std::int64_t lane : d.integers("dcm/tension_lane")) {
    const std::size_t l = lane;
    check_same(d, "dcm/tension_lane", l < s.n_lane() ? 1 : 0, 1);
    const auto n = std::ssize(s.group[l / kLanes].topology->edge);
    check_same(d, "dcm/tension", numbers.end() - at >= 2 * n ? 1 : 0, 1);
    s.tension[l].force.assign(at, at + n);
    s.tension[l].length.assign(at + n, at + 2 * n);
    at += 2 * n;
  }
}

dcm::NucleusMesh nucleus_of(const io::CheckpointData& d, std::size_t group) {
  if (!d.contains("dcm/nucleus_nodes")) return {};
  const std::vector<std::int64_t>& nodes = d.integers("dcm/nucleus_nodes");
  const std::vector<double>& size = d.numbers("dcm/nucleus_size");
  check_same(d, "dcm/nucleus_nodes", group < nodes.size() ? 1 : 0, 1);
  check_same(d, "dcm/nucleus_size", size.size(), nodes.size());
  if (nodes[group] == 0) return {};
  return {&geometry::shared_icosphere(as_int(d, "dcm/nucleus_nodes", nodes[group])), size[group]};
}

/// Reads the link lengths at birth of the cells that remember their shape.
/// @pre get_birth_shapes() of the same state
void get_birth_links(const io::CheckpointData& d, dcm::State& s) {
  if (!d.contains("dcm/birth_link")) return;
  const std::vector<double>& numbers = d.numbers("dcm/birth_link");
  auto at = numbers.begin();
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    const auto n = static_cast<std::ptrdiff_t>(s.group[l / kLanes].nucleus.n_node());
    if (n == 0 || s.birth[l].edge.empty()) continue;
    check_same(d, "dcm/birth_link", numbers.end() - at >= n ? 1 : 0, 1);
    s.birth[l].link = std::vector<double>(at, at + n);
    at += n;
  }
}

void get_shells(const io::CheckpointData& d, dcm::State& s) {
  s = {};
  const std::vector<std::int64_t>& group = d.integers("dcm/group");
  std::size_t rows = 0;
  for (std::size_t k = 0; k + 1 < group.size(); k += 2) {
    const geometry::Topology& topology =
        geometry::shared_icosphere(as_int(d, "dcm/group", group[k + 1]));
    s.group.push_back({&topology, rows, as_int(d, "dcm/group", group[k]), nucleus_of(d, k / 2)});
    rows += s.group.back().n_point();
  }
  const std::size_t n = s.group.size() * kLanes;
  s.position = HeldRows<double>(d.numbers("dcm/position"));
  s.lineage = d.integers("dcm/lineage");
  s.volume = unflatten(d.numbers("dcm/volume"));
  s.pull = unflatten_points(d.numbers("dcm/pull"));
  check_same(d, "dcm/position", s.position.size(), rows * kPointStride);
  check_same(d, "dcm/lineage", s.lineage.size(), n);
  check_same(d, "dcm/volume", s.volume.size(), n);
  get_birth_shapes(d, s);
  get_birth_links(d, s);
  get_tensions(d, s);
  check_same(d, "dcm/pull", s.pull.size(), n);
}

void get_spheres(const io::CheckpointData& d, cbm::State& s) {
  s = {};
  s.lineage = d.integers("cbm/lineage");
  const std::size_t n = s.lineage.size();
  s.position = HeldRows<double>(d.numbers("cbm/position"));
  const std::vector<std::int64_t>& type = d.integers("cbm/type");
  std::vector<int> types;
  for (const std::int64_t t : type) types.push_back(as_int(d, "cbm/type", t));
  s.type = PagedValues(types);
  s.volume = HeldRows<Ramp>(unflatten(d.numbers("cbm/volume")));
  s.strength = PagedValues(unflatten(d.numbers("cbm/strength")));
  s.young = PagedValues(d.numbers("cbm/young"));
  s.pull = PagedValues(unflatten_points(d.numbers("cbm/pull")));
  check_same(d, "cbm/position", s.position.size(), (n + kLanes - 1) / kLanes * kPointStride);
  check_same(d, "cbm/type", s.type.size(), n);
  check_same(d, "cbm/volume", s.volume.size(), n);
  check_same(d, "cbm/strength", s.strength.size(), n);
  check_same(d, "cbm/young", s.young.size(), n);
  check_same(d, "cbm/pull", s.pull.size(), n);
  const std::vector<std::int64_t>& t = d.integers("cbm/touching");
  // A partner that is a boundary is negative.
  for (std::size_t k = 0; k + 1 < t.size(); k += 2)
    s.touching.emplace_back(
        as_int(d, "cbm/touching", t[k]),
        t[k + 1] < 0 ? ~as_int(d, "cbm/touching", ~t[k + 1]) : as_int(d, "cbm/touching", t[k + 1]));
}

void get_life(const io::CheckpointData& d, coupling::State& s) {
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell(), n = d.integers("life/parent").size();
  const auto integers = [&](const char* what) -> const std::vector<std::int64_t>& {
    check_same(d, what, d.integers(what).size(), n);
    return d.integers(what);
  };
  const auto numbers = [&](const char* what) -> const std::vector<double>& {
    check_same(d, what, d.numbers(what).size(), n);
    return d.numbers(what);
  };
  const auto check_none_or_all = [&](const char* what, std::size_t found) {
    check_same(d, what, found == 0 ? n_cell : found, n_cell);
  };
  check_none_or_all("life/parent", n);
  const auto &parent = integers("life/parent"), &founder = integers("life/founder"),
             &fate = integers("life/fate");
  const auto &birth = numbers("life/birth"), &volume = numbers("life/birth_volume"),
             &duration = numbers("life/duration"), &wait = numbers("life/wait_until");
  s.cycle.clear();
  for (std::size_t k = 0; k < n; ++k)
    s.cycle.push_back({parent[k], founder[k],
                       static_cast<coupling::Fate>(std::min(as_int(d, "life/fate", fate[k]), 127)),
                       birth[k], volume[k], duration[k], wait[k]});
  s.life_interval = d.count("life/interval");
  s.next_lineage = d.count("life/next_lineage");
  s.divisions = d.count("life/divisions");
  s.deaths = d.count("life/deaths");
  const std::vector<std::int64_t>& asleep = d.integers("life/asleep");
  check_none_or_all("life/asleep", asleep.size());
  s.asleep.assign(asleep.begin(), asleep.end());
  s.sleep_interval = d.count("life/sleep_interval");
}

void get_zoom(const io::CheckpointData& d, coupling::State& s) {
  if (!d.contains("zoom/model_since")) return;  // files of 0.1.0 have none
  s.model_since = d.numbers("zoom/model_since");
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  check_same(d, "zoom/model_since", s.model_since.empty() ? n_cell : s.model_since.size(), n_cell);
  const std::vector<std::int64_t>& cell = d.integers("zoom/fading/cell");
  const std::vector<Vec3> force = unflatten_points(d.numbers("zoom/fading/force"));
  const std::vector<double>& virial = d.numbers("zoom/fading/virial");
  const std::vector<Ramp> share = unflatten(d.numbers("zoom/fading/share"));
  const std::vector<Vec3> apart = unflatten_points(d.numbers("zoom/fading/apart"));
  const std::vector<double>& reach = d.numbers("zoom/fading/reach");
  check_same(d, "zoom/fading/cell", cell.size(), 2 * force.size());
  check_same(d, "zoom/fading/virial", virial.size(), force.size());
  check_same(d, "zoom/fading/share", share.size(), force.size());
  check_same(d, "zoom/fading/apart", apart.size(), force.size());
  check_same(d, "zoom/fading/reach", reach.size(), force.size());
  s.fading.clear();
  for (std::size_t k = 0; k < force.size(); ++k)
    s.fading.push_back(
        {cell[2 * k], cell[2 * k + 1], force[k], virial[k], share[k], apart[k], reach[k]});
}

}  // namespace

void get_state(const io::CheckpointData& d, const StateTypes& types, coupling::State& s) {
  s.holder.clear();
  s.cell_holder.clear();
  get_shells(d, s.dcm);
  get_spheres(d, s.cbm);
  get_tree(d, s.tree);
  get_life(d, s);
  get_zoom(d, s);
  get_substances(d, s);
  s.clock.phase = static_cast<coupling::Phase>(as_int(d, "clock/phase", d.count("clock/phase")));
  s.clock.coarse = d.count("clock/coarse") != 0;
  // Files of 0.1.0 have neither of the next two, others may lack the third.
  if (d.contains("clock/events_due"))
    s.clock.due = static_cast<coupling::EventsDue>(
        std::min(as_int(d, "clock/events_due", d.count("clock/events_due")), 255));
  if (d.contains("clock/shortened")) s.clock.shortened = d.count("clock/shortened");
  if (d.contains("clock/longest_solve"))
    s.clock.longest_solve = as_int(d, "clock/longest_solve", d.count("clock/longest_solve"));
  visit_numbers(s.clock, s.balance,
                [&](const char* name, double& value) { value = d.number(name); });
  visit_counts(s.clock, [&](const char* name, auto& value) { value = d.count(name); });
  const std::vector<double>& last_move = d.numbers("solver/last_move");
  s.last_move.assign(last_move.begin(), last_move.end());
  const std::vector<std::int64_t>& leader = d.integers("leaders/cell");
  s.leader.assign(leader.begin(), leader.end());
  s.leader_interval = d.count("leaders/interval");
  s.settle_pressure = d.numbers("settle/pressure");
  s.settle_time = d.number("settle/time");
  check_state(s, types, d.source());
}

}  // namespace acinus::runs
