#include "coupling/world/world.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

#include "core/parallel/threads.hpp"

namespace acinus::coupling {

int count_cells(const State& s) {
  return dcm::count_cells(s.dcm) + static_cast<int>(s.cbm.n_cell());
}

int count_asleep(const State& s) {
  return static_cast<int>(std::ranges::count(s.asleep, std::uint8_t{1}));
}

double time_since_start(const World& w) {
  const Clock& c = w.state.clock;
  if (c.phase == Phase::kRun) return c.time - c.origin;
  const StartUp& p = w.params.start_up;
  return c.time - (p.growth_time + p.adhesion_ramp + p.max_settle);
}

Controls controls_at(const Clock& clock, const StartUp& start_up) {
  switch (clock.phase) {
    case Phase::kGrow:
      return {0, 0, false};
    case Phase::kAdhere: {
      const double done = start_up.adhesion_ramp > 0
                              ? (clock.time - clock.phase_start) / start_up.adhesion_ramp
                              : 1.0;
      return {std::clamp(done, 0.0, 1.0), 1, false};
    }
    case Phase::kSettle:
      return {1, 1, false};
    case Phase::kRun:
      break;
  }
  return {};
}

std::vector<std::uint8_t> active_lanes(const State& s) {
  const std::size_t n_lane = s.dcm.n_lane() + s.cbm.n_row() * kLanes;
  std::vector<std::uint8_t> active(n_lane, 0);
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) active[l] = s.dcm.active(l) ? 1 : 0;
  std::fill_n(active.begin() + static_cast<std::ptrdiff_t>(s.dcm.n_lane()), s.cbm.n_cell(),
              std::uint8_t{1});
  if (!s.tree.node.empty()) {
    active.resize(n_lane + kLanes, 0);
    active[n_lane] = 1;
  }
  return active;
}

std::vector<double> gather_positions(const State& s) {
  RowVector<double> x;
  gather_positions(s, x);
  return {x.begin(), x.end()};
}
void gather_positions(const State& s, RowVector<double>& out) {
  const auto &dcm = s.dcm.position, &cbm = s.cbm.position;
  const std::size_t n_cell = dcm.size() + cbm.size();
  set_size(out, count_unknowns(s));
  for_each_number(dcm.size(), [&](std::size_t k) { out[k] = dcm[k]; });
  for_each_number(cbm.size(), [&](std::size_t k) { out[dcm.size() + k] = cbm[k]; });
  if (!s.tree.node.empty()) copy_places(s.tree, std::span(out).subspan(n_cell));
}

const double* position_of(const State& s, Address point) {
  const std::size_t n = s.dcm.position.size();
  return point < n ? s.dcm.position.data() + point : s.cbm.position.data() + (point - n);
}

double* position_of(State& s, Address point) {
  return const_cast<double*>(position_of(std::as_const(s), point));
}

std::uint64_t hash_state(const State& s) {
  XXH64_state_t* hash = XXH64_createState();
  XXH64_reset(hash, 0);
  auto add = [&](const auto& v) {
    if (!v.empty()) XXH64_update(hash, v.data(), v.size() * sizeof(v[0]));
  };
  add(s.dcm.position);
  add(s.cbm.position);
  for (const Vec3& x : s.tree.node) add(std::array{x.x(), x.y(), x.z()});
  for (const Eigen::Quaterniond& q : s.tree.rotation) add(std::array{q.w(), q.x(), q.y(), q.z()});
  add(s.dcm.lineage);
  add(s.cbm.lineage);
  for (const double young : s.cbm.young) add(std::array{young});
  const auto add_ramps = [&](const auto& v) {
    for (const Ramp& r : v) add(std::array{r.from, r.to, r.start, r.end});
  };
  add_ramps(s.dcm.volume);
  add_ramps(s.cbm.volume);
  add_ramps(s.cbm.strength);
  for (const auto& [a, b] : s.cbm.touching) add(std::array{a, b});
  add(s.last_move);
  add(s.leader);
  add(s.asleep);
  add(s.model_since);
  for (const FadingForce& f : s.fading) {
    add(std::array{f.a, f.b});
    add(std::array{f.force.x(), f.force.y(), f.force.z(), f.virial, f.share.start, f.share.end});
    add(std::array{f.apart.x(), f.apart.y(), f.apart.z(), f.reach});
  }
  for (const Cycle& c : s.cycle)
    add(std::array{c.birth, c.birth_volume, c.duration, c.wait_until, static_cast<double>(c.parent),
                   static_cast<double>(c.founder), static_cast<double>(c.fate)});
  for (const dcm::BirthShape& b : s.dcm.birth) {
    add(b.edge);
    add(b.triangle);
    add(b.link);
    if (!b.edge.empty()) add(std::array{b.area, b.weight.start, b.weight.end});
  }
  for (const dcm::EdgeTension& t : s.dcm.tension) {
    add(t.force);
    add(t.length);
  }
  add(std::array{s.clock.time, s.clock.origin, s.clock.step, s.clock.last_step});
  add(std::array{static_cast<std::int64_t>(s.clock.phase), s.clock.accepted,
                 static_cast<std::int64_t>(s.clock.coarse ? 1 : 0), s.leader_interval,
                 s.sleep_interval, s.life_interval, s.next_lineage, s.divisions, s.deaths});
  for (const SubstanceState& field : s.substance) {
    add(field.concentration);
    if (!field.open.empty()) add(field.open);
    if (const InsideState& inside = field.inside; !inside.cell.empty()) {
      add(inside.cell);
      add(inside.voxel);
      add(inside.volume);
      add(inside.concentration);
    }
    add(std::array{field.secreted, field.entered, field.supplied, field.decayed});
    if (field.layers != substances::Layers{}) add(field.layers);
  }
  const std::uint64_t value = XXH64_digest(hash);
  XXH64_freeState(hash);
  return value;
}

std::string name_body(const State& s, std::size_t lane) {
  if (lane < s.dcm.n_lane()) return name_dcm(s, lane);
  const std::size_t cell = lane - s.dcm.n_lane();
  return cell < s.cbm.n_cell() ? name_cbm(s, cell) : std::string("the vessels");
}
std::string name_dcm(const State& s, std::size_t lane) {
  return fmt::format("DCM cell {}", s.dcm.lineage[lane]);
}
std::string name_cbm(const State& s, std::size_t cell) {
  return fmt::format("CBM cell {}", s.cbm.lineage[cell]);
}

}  // namespace acinus::coupling
