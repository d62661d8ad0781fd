#include "coupling/start_up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers/time_grid.hpp"
#include "core/sphere.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/step/held_cells.hpp"

namespace acinus::coupling {
namespace {

constexpr double kSettleCheckInterval = 600;  ///< s between checks of a settling tissue
constexpr double kPressureFloor = 1e-3;       ///< kPa, least pressure that changes are related to

double largest_speed(const State& s) {
  if (s.clock.last_step <= 0) return std::numeric_limits<double>::infinity();
  double largest2 = 0;
  const std::size_t n_place = s.last_move.size() / kPointStride - s.tree.node.size();
  for (std::size_t row = 0; row < n_place; ++row)  // the last ones are rotations
    for (int l = 0; l < kLanes; ++l)
      largest2 =
          std::max(largest2, load_point(s.last_move.data(), make_address(row, l)).squaredNorm());
  return std::sqrt(largest2) / s.clock.last_step;
}

/// Mean change of the cells' pressures since the last check over their mean magnitude, 1/s.
double pressure_drift(World& world, Workspace& work) {
  State& s = world.state;
  observe(world, work);
  std::vector<double> now;
  for (const CellMeasure& m : measure_cells(world, work)) now.push_back(m.cytosol_pressure);
  double drift = std::numeric_limits<double>::infinity();
  if (s.settle_pressure.size() == now.size() && s.clock.time > s.settle_time) {
    double change = 0, size = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      change += std::abs(now[k] - s.settle_pressure[k]);
      size += std::abs(now[k]);
    }
    const double n = static_cast<double>(now.size());
    drift = change / n / std::max(size / n, kPressureFloor) / (s.clock.time - s.settle_time);
  }
  s.settle_pressure = now;
  s.settle_time = s.clock.time;
  return drift;
}

void enter(Clock& c, Phase phase) {
  c.phase = phase;
  c.phase_start = c.time;
  c.last_step = 0;  // forces jump: the last step predicts nothing
}

void begin_run(Clock& c) {
  enter(c, Phase::kRun);
  c.origin = c.time;
}

}  // namespace

void begin_start_up(World& world, double initial_radius) {
  State& s = world.state;
  const double end = world.params.start_up.growth_time;
  const double initial_volume = sphere_volume(initial_radius);
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    if (!s.dcm.active(l)) continue;
    const double full = s.dcm.volume[l].to;
    dcm::scale_cell(std::cbrt(initial_volume / full), l, s.dcm);
    s.dcm.volume[l] = {initial_volume, full, 0, end};
  }
  for (Ramp& v : s.cbm.volume) v = {initial_volume, v.to, 0, end};
  s.clock.phase = Phase::kGrow;
}

double time_to_phase_event(const World& world) {
  const Clock& c = world.state.clock;
  const StartUp& p = world.params.start_up;
  const double in_phase = c.time - c.phase_start;
  switch (c.phase) {
    case Phase::kGrow:
      return p.growth_time - in_phase;
    case Phase::kAdhere:
      return p.adhesion_ramp - in_phase;
    case Phase::kSettle:
      return std::min(p.max_settle,
                      kSettleCheckInterval *
                          (std::floor(in_phase / kSettleCheckInterval + kGridSlack) + 1)) -
             in_phase;
    case Phase::kRun:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

std::string update_phase(World& world, Workspace& work) {
  Clock& c = world.state.clock;
  const StartUp& p = world.params.start_up;
  const double in_phase = c.time - c.phase_start;
  if (c.phase == Phase::kGrow && in_phase >= p.growth_time - kSameTime) {
    enter(c, Phase::kAdhere);
    return fmt::format("cells are full grown after {:.2f} h; adhesion ramps up", c.time / 3600);
  }
  if (c.phase == Phase::kAdhere && in_phase >= p.adhesion_ramp - kSameTime) {
    enter(c, Phase::kSettle);
    return fmt::format("full adhesion after {:.2f} h; settling", c.time / 3600);
  }
  if (c.phase != Phase::kSettle) return {};
  const bool capped = in_phase >= p.max_settle - kSameTime;
  const double checks = in_phase / kSettleCheckInterval;
  if (!capped && std::abs(checks - std::round(checks)) * kSettleCheckInterval > 1e-6) return {};
  if (in_phase < 1e-6 && !capped) return {};
  if (p.max_settle < kSameTime) {
    begin_run(c);
    return fmt::format("t = 0 after {:.2f} h of start-up, without settling", c.time / 3600);
  }
  complete_cells(world.ranks, world.state);
  const double speed = largest_speed(world.state), drift = pressure_drift(world, work);
  const bool rest = speed < p.speed_tolerance && drift < p.pressure_tolerance;
  if (!rest && !capped) return {};
  begin_run(c);
  const std::string end =
      rest ? "at rest" : fmt::format("not equilibrated within {:.3g} h", p.max_settle / 3600);
  return fmt::format(
      "t = 0 after {:.2f} h of start-up: {} (fastest node {:.2g} um/min, pressures change {:.2g} "
      "%/h)",
      c.time / 3600, end, 60 * speed, 3.6e5 * drift);
}

}  // namespace acinus::coupling
