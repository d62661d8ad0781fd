#include "coupling/world/world.hpp"

#include <fmt/format.h>

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
