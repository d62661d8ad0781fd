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

/// Writes the birth shapes that are still remembered: lane, then weight, area, edges and triangles.
void put_birth_shapes(const dcm::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> lane;
  std::vector<double> numbers;
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    const dcm::BirthShape& b = s.birth[l];
    if (b.edge.empty()) continue;
    lane.push_back(static_cast<std::int64_t>(l));
    numbers.insert(numbers.end(),
                   {b.weight.from, b.weight.to, b.weight.start, b.weight.end, b.area});
    numbers.insert(numbers.end(), b.edge.begin(), b.edge.end());
    numbers.insert(numbers.end(), b.triangle.begin(), b.triangle.end());
  }
  d.put("dcm/birth_lane", lane);
  d.put("dcm/birth_shape", numbers);
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

/// Writes the cortex tensions of the cells that have any: lane, then forces and lengths of their
/// edges.
void put_tensions(const dcm::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> lane;
  std::vector<double> numbers;
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    const dcm::EdgeTension& t = s.tension[l];
    if (t.is_new()) continue;
    lane.push_back(static_cast<std::int64_t>(l));
    numbers.insert(numbers.end(), t.force.begin(), t.force.end());
    numbers.insert(numbers.end(), t.length.begin(), t.length.end());
  }
  d.put("dcm/tension_lane", lane);
  d.put("dcm/tension", numbers);
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

/// Writes the nuclei by group: number of nodes (0: no nucleus) and size relative to the cell.
void put_nuclei(const dcm::State& s, io::CheckpointData& d) {
  if (!dcm::has_nuclei(s)) return;
  std::vector<std::int64_t> nodes;
  std::vector<double> size, link;
  for (const dcm::Group& g : s.group) {
    nodes.push_back(g.nucleus.n_node());
    size.push_back(g.nucleus.size);
  }
  for (const dcm::BirthShape& b : s.birth) link.insert(link.end(), b.link.begin(), b.link.end());
  d.put("dcm/nucleus_nodes", nodes);
  d.put("dcm/nucleus_size", size);
  d.put("dcm/birth_link", link);
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

void put_life(const coupling::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> parent, founder, fate;
  std::vector<double> birth, birth_volume, duration, wait_until;
  for (const coupling::Cycle& c : s.cycle) {
    parent.push_back(c.parent);
    founder.push_back(c.founder);
    fate.push_back(static_cast<std::int64_t>(c.fate));
    birth.push_back(c.birth);
    birth_volume.push_back(c.birth_volume);
    duration.push_back(c.duration);
    wait_until.push_back(c.wait_until);
  }
  d.put("life/parent", parent);
  d.put("life/founder", founder);
  d.put("life/fate", fate);
  d.put("life/birth", birth);
  d.put("life/birth_volume", birth_volume);
  d.put("life/duration", duration);
  d.put("life/wait_until", wait_until);
  d.put_count("life/interval", s.life_interval);
  d.put_count("life/next_lineage", s.next_lineage);
  d.put_count("life/divisions", s.divisions);
  d.put_count("life/deaths", s.deaths);
  d.put("life/asleep", as_integers(s.asleep));
  d.put_count("life/sleep_interval", s.sleep_interval);
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

void put_zoom(const coupling::State& s, io::CheckpointData& d) {
  d.put("zoom/model_since", s.model_since);
  std::vector<std::int64_t> cell;
  std::vector<Vec3> force, apart;
  std::vector<double> virial, reach;
  std::vector<Ramp> share;
  for (const coupling::FadingForce& f : s.fading) {
    cell.insert(cell.end(), {f.a, f.b});
    force.push_back(f.force);
    virial.push_back(f.virial);
    share.push_back(f.share);
    apart.push_back(f.apart);
    reach.push_back(f.reach);
  }
  d.put("zoom/fading/cell", cell);
  d.put("zoom/fading/force", flatten(force));
  d.put("zoom/fading/virial", virial);
  d.put("zoom/fading/share", flatten(share));
  d.put("zoom/fading/apart", flatten(apart));
  d.put("zoom/fading/reach", reach);
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

/// Calls f(name, value) for every floating-point member of the clock and the force balance.
template <class Clock, class Balance, class F>
void visit_numbers(Clock& c, Balance& b, F f) {
  f("clock/time", c.time);
  f("clock/origin", c.origin);
  f("clock/phase_start", c.phase_start);
  f("clock/step", c.step);
  f("clock/last_step", c.last_step);
  f("balance/momentum", b.momentum);
  f("balance/torque", b.torque);
  f("balance/friction_torque", b.friction_torque);
}

/// Calls f(name, value) for every integer member of the clock.
template <class Clock, class F>
void visit_counts(Clock& c, F f) {
  f("clock/accepted", c.accepted);
  f("clock/rejected", c.rejected);
  f("clock/cg_iterations", c.cg_iterations);
  f("clock/solves", c.solves);
}

}  // namespace

void put_state(const coupling::State& s, io::CheckpointData& d) {
  std::vector<std::int64_t> group;
  for (const dcm::Group& g : s.dcm.group)
    group.insert(group.end(), {g.type, static_cast<std::int64_t>(g.topology->n_node)});
  d.put("dcm/group", group);
  d.put("dcm/position", std::vector<double>(s.dcm.position.begin(), s.dcm.position.end()));
  d.put("dcm/lineage", s.dcm.lineage);
  d.put("dcm/volume", flatten(s.dcm.volume));
  put_birth_shapes(s.dcm, d);
  put_nuclei(s.dcm, d);
  put_tensions(s.dcm, d);
  d.put("dcm/pull", flatten(s.dcm.pull));
  d.put("cbm/position", std::vector<double>(s.cbm.position.begin(), s.cbm.position.end()));
  d.put("cbm/lineage", s.cbm.lineage);
  d.put("cbm/type", as_integers(s.cbm.type));
  d.put("cbm/volume", flatten(s.cbm.volume));
  d.put("cbm/strength", flatten(s.cbm.strength));
  d.put("cbm/young", std::vector<double>(s.cbm.young.begin(), s.cbm.young.end()));
  d.put("cbm/pull", flatten(s.cbm.pull));
  std::vector<std::int64_t> touching;
  for (const auto& [a, b] : s.cbm.touching) touching.insert(touching.end(), {a, b});
  d.put("cbm/touching", touching);
  put_tree(s.tree, d);
  put_life(s, d);
  put_zoom(s, d);
  put_substances(s, d);
  d.put_count("clock/phase", static_cast<std::int64_t>(s.clock.phase));
  d.put_count("clock/coarse", s.clock.coarse ? 1 : 0);
  d.put_count("clock/events_due", static_cast<std::int64_t>(s.clock.due));
  visit_numbers(s.clock, s.balance,
                [&](const char* name, double value) { d.put_number(name, value); });
  visit_counts(s.clock, [&](const char* name, std::int64_t value) { d.put_count(name, value); });
  d.put_count("clock/shortened", s.clock.shortened);
  d.put("solver/last_move", std::vector<double>(s.last_move.begin(), s.last_move.end()));
  d.put("leaders/cell", as_integers(s.leader));
  d.put_count("leaders/interval", s.leader_interval);
  d.put("settle/pressure", s.settle_pressure);
  d.put_number("settle/time", s.settle_time);
}

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
  // Files of 0.1.0 have neither of the next two.
  if (d.contains("clock/events_due"))
    s.clock.due = static_cast<coupling::EventsDue>(
        std::min(as_int(d, "clock/events_due", d.count("clock/events_due")), 255));
  if (d.contains("clock/shortened")) s.clock.shortened = d.count("clock/shortened");
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
