#include "calibration/clump.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/step/stages.hpp"

namespace acinus::calibration {
namespace {

constexpr std::size_t kShell = 14;

/// d of the inner cells.
double mean_overlap(const Moment& moment, const std::vector<std::size_t>& inner) {
  double sum = 0;
  for (const std::size_t i : inner)
    for (std::size_t j = 0; j < moment.center.size(); ++j) {
      const double apart = (moment.center[i] - moment.center[j]).norm();
      if (j != i) sum += std::max(0.0, 1 - apart / (moment.radius[i] + moment.radius[j]));
    }
  return sum / (static_cast<double>(inner.size()) * cbm::kNeighbours);
}

}  // namespace

std::size_t find_central_cell(std::span<const coupling::CellMeasure> cells, const Vec3& point) {
  const auto nearest = std::ranges::min_element(
      cells, {}, [&](const coupling::CellMeasure& c) { return (c.center - point).squaredNorm(); });
  return static_cast<std::size_t>(nearest - cells.begin());
}

ClumpSample measure_clump(std::span<const coupling::CellMeasure> cells, std::size_t central) {
  const coupling::CellMeasure& middle = cells[central];
  std::vector<double> relative;
  double sum = 0;
  for (const coupling::CellMeasure& c : cells) {
    if (&c == &middle) continue;
    relative.push_back(1 - (c.center - middle.center).norm() / (c.radius + middle.radius));
    sum += std::max(0.0, relative.back());
  }
  ClumpSample s;
  s.overlap = sum / cbm::kNeighbours;
  std::ranges::sort(relative, std::greater());
  relative.resize(std::min(relative.size(), kShell));
  for (const double r : relative) s.shell_overlap += r / static_cast<double>(relative.size());
  s.contacts = middle.contacts;
  s.force = middle.normal_force;
  s.contact_force = middle.contact_force;
  s.pressure = middle.pressure;
  s.volume = middle.volume / sphere_volume(middle.radius);
  return s;
}

std::vector<coupling::CellMeasure> observe_cells(const coupling::World& world,
                                                 coupling::Workspace& work) {
  coupling::observe(world, work);
  return coupling::measure_cells(world, work);
}

void advance_to(coupling::World& world, coupling::Workspace& work, double time) {
  const coupling::LoopResult result = coupling::run_loop(
      {.time_left = coupling::time_left_until(world.state.clock, time),
       .advance = [&](double limit) { return coupling::advance(world, work, limit); }});
  check(result.ok,
        fmt::format("calibration: a step fails {:.4g} h after t = 0: {}. Cells concerned: {}",
                    coupling::time_since_start(world) / 3600, result.last.cause,
                    fmt::join(result.last.cells, ", ")),
        Exit::kCannotContinue);
}

std::vector<std::size_t> find_inner_cells(const std::vector<Moment>& history, const Vec3& point) {
  constexpr double kPressing = 0.1, kAway = 1.25;
  std::vector<double> force;
  for (const Moment& m : history)
    force.push_back(std::accumulate(m.force.begin(), m.force.end(), 0.0));
  std::vector<std::size_t> inner;
  if (history.empty()) return inner;
  const double enough = kPressing * *std::ranges::max_element(force);
  auto presses = std::ranges::find_if(force, [&](double f) { return f >= enough; });
  if (presses == force.end()) presses = std::ranges::max_element(force);  // all pull
  const Moment& moment = history[static_cast<std::size_t>(presses - force.begin())];
  const auto distance = [&](std::size_t i) { return (moment.center[i] - point).norm(); };
  std::size_t middle = 0;
  for (std::size_t i = 0; i < moment.center.size(); ++i) {
    if (moment.capsule - distance(i) > kAway * moment.radius[i]) inner.push_back(i);
    if (distance(i) < distance(middle)) middle = i;
  }
  if (inner.empty() && !moment.center.empty()) inner.push_back(middle);
  return inner;
}

Bulk measure_bulk(const Moment& moment, const std::vector<std::size_t>& inner) {
  Bulk b{mean_overlap(moment, inner), 0};
  for (const std::size_t i : inner) b.force += moment.force[i] / static_cast<double>(inner.size());
  return b;
}

std::vector<Bulk> measure_bulks(const std::vector<Moment>& history,
                                const std::vector<std::size_t>& inner) {
  std::vector<Bulk> bulks;
  for (const Moment& m : history) bulks.push_back(measure_bulk(m, inner));
  return bulks;
}

std::vector<std::size_t> find_pressing(const std::vector<Bulk>& bulks, double highest) {
  constexpr double kPressing = 0.01;
  double largest = 0;
  for (const Bulk& b : bulks) largest = std::max(largest, b.force);
  std::vector<std::size_t> pressing;
  for (std::size_t k = 0; k < bulks.size(); ++k)
    if (bulks[k].force >= kPressing * largest && bulks[k].overlap <= highest) pressing.push_back(k);
  return pressing;
}

Moment as_spheres(const Moment& moment, const cbm::Params& sphere,
                  const std::vector<std::size_t>& inner) {
  const double young =
      cbm::corrected_modulus(sphere.correction, sphere.young, mean_overlap(moment, inner)).value;
  std::vector<cbm::NewCell> cells;
  for (std::size_t k = 0; k < moment.center.size(); ++k)
    cells.push_back(
        {static_cast<std::int64_t>(k), 1, moment.center[k], moment.radius[k], young, Vec3::Zero()});
  for (const std::size_t k : inner) {
    cells[k].type = 0;
    cells[k].young = sphere.young;
  }
  coupling::World world;
  world.params.cbm = {sphere, sphere};
  world.params.cbm[1].correction = {};
  world.state.cbm = cbm::make_state(cells);
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  Moment spheres = moment;
  spheres.force.clear();
  for (const coupling::CellMeasure& c : observe_cells(world, work))
    spheres.force.push_back(c.normal_force);
  return spheres;
}

Bulk bulk_as_spheres(const Moment& moment, const cbm::Params& sphere, const Squeeze& squeeze) {
  return measure_bulk(as_spheres(moment, sphere, squeeze.inner), squeeze.inner);
}

}  // namespace acinus::calibration
