#include "bench/work_precision/work_precision_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "coupling/measure/difference.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::bench {
namespace {

/// CPU time below which a run is repeated, up to kMostRepeats times, s.
constexpr double kLeastTimedCpu = 1;
constexpr int kMostRepeats = 3;

void set_numerics(const PrecisionSetting& setting, coupling::Numerics& n) {
  const coupling::Numerics usual;
  n.max_step = setting.step;
  n.min_step = setting.adaptive ? usual.min_step : setting.step;
  n.adaptive = setting.adaptive;
  n.tolerance = setting.tolerance;
  n.max_move = setting.adaptive ? usual.max_move : 0;
  n.cg.tolerance = setting.cg_tolerance;
  n.integrator = setting.integrator;
  n.extrapolate = setting.extrapolate;
}

/// Runs until the simulation has at least so many cells.
coupling::LoopResult grow_to(coupling::Simulation& simulation, int cells) {
  const auto enough = [&] { return coupling::count_cells(simulation.world().state) >= cells; };
  if (enough()) return {};
  return simulation.run_until(std::numeric_limits<double>::infinity(),
                              {.events_over = [&] { return !enough(); }});
}

/// Extent of points along a direction, um.
double extent(const std::vector<Vec3>& point, const Vec3& axis) {
  double low = axis.dot(point.front()), high = low;
  for (const Vec3& x : point) {
    low = std::min(low, axis.dot(x));
    high = std::max(high, axis.dot(x));
  }
  return high - low;
}

/// Strain of the first deformable cell along an axis, relative to its rest mesh.
/// @pre the mesh is not rotated
double strain_of_first(const coupling::State& state, const Vec3& axis) {
  std::vector<Vec3> node;
  dcm::copy_nodes(state.dcm, 0, node);
  const double radius = dcm::reference_radii(state.dcm, state.clock.time).front();
  return extent(node, axis) / (radius * extent(state.dcm.group.front().topology->rest, axis)) - 1;
}

Sample take_sample(coupling::Simulation& simulation, const Vec3& axis) {
  const coupling::World& world = simulation.world();
  coupling::Workspace& work = simulation.work();
  Sample s;
  coupling::observe(world, work);
  std::vector<coupling::CellMeasure> cells = coupling::measure_cells(world, work);
  std::ranges::sort(cells, {}, &coupling::CellMeasure::id);
  for (const coupling::CellMeasure& m : cells) {
    s.id.push_back(m.id);
    s.center.push_back(m.center);
    s.pressure.push_back(m.cytosol_pressure);
    s.volume.push_back(m.volume);
    s.contact_force.push_back(m.contact_force);
  }
  if (axis != Vec3::Zero()) s.strain = strain_of_first(world.state, axis);
  return s;
}

}  // namespace

const coupling::World& WarmScene::start(const Discretisation& space) {
  const auto found = start_.find(space);
  if (found != start_.end()) return found->second;
  coupling::World world =
      runs::build_world(runs::parse_scene(scene_.text(space), scene_.name), Ranks::serial()).world;
  if (scene_.prepare) scene_.prepare(world);
  // Divisions bring moments that long steps cannot take.
  set_numerics({.space = space,
                .step = scene_.warm_up_step,
                .cg_tolerance = scene_.grow_to > 0 ? 1e-2 : 1e-5,
                .adaptive = scene_.grow_to > 0,
                .extrapolate = scene_.grow_to > 0},
               world.params.numerics);
  coupling::Simulation simulation(std::move(world));
  coupling::LoopResult result = grow_to(simulation, scene_.grow_to);
  if (result.ok) result = simulation.run_until(simulation.time() + scene_.warm_up);
  check(result.ok, scene_.name + ": the warm-up failed: " + result.last.cause,
        Exit::kCannotContinue);
  coupling::World& warm = simulation.world();
  warm.state.clock.origin = warm.state.clock.time;
  warm.state.clock.step = 0;
  if (scene_.begin) scene_.begin(warm);
  return start_.emplace(space, std::move(warm)).first->second;
}

Trajectory WarmScene::run(const PrecisionSetting& setting, double window, int samples) {
  coupling::World world = start(setting.space);
  set_numerics(setting, world.params.numerics);
  const coupling::Clock before = world.state.clock;
  coupling::Simulation simulation(std::move(world));
  Trajectory t;
  for (int k = 1; k <= samples && t.failure.empty(); ++k) {
    const double cpu = cpu_seconds();
    const coupling::LoopResult result = simulation.run_until(window * k / samples);
    if (!result.ok) t.failure = result.last.cause;
    t.cpu += cpu_seconds() - cpu;
    if (t.failure.empty()) t.sample.push_back(take_sample(simulation, scene_.axis));
  }
  const coupling::Clock& clock = simulation.world().state.clock;
  t.steps = clock.accepted - before.accepted;
  t.rejected = clock.rejected - before.rejected;
  t.cg_iterations = clock.cg_iterations - before.cg_iterations;
  return t;
}

/// Restricts a sample to the cells of another one. A division one step later leaves the mother in
/// one sample and her daughters in the other.
Sample select_common(const Sample& from, const Sample& other) {
  Sample s;
  s.strain = from.strain;
  for (std::size_t k = 0; k < from.id.size(); ++k) {
    if (!std::ranges::binary_search(other.id, from.id[k])) continue;
    s.id.push_back(from.id[k]);
    s.center.push_back(from.center[k]);
    s.pressure.push_back(from.pressure[k]);
    s.volume.push_back(from.volume[k]);
    s.contact_force.push_back(from.contact_force[k]);
  }
  return s;
}

Errors compute_errors(const Trajectory& trajectory, const Trajectory& reference) {
  ACINUS_ASSERT(trajectory.sample.size() == reference.sample.size());
  std::vector<Sample> found, wanted;
  for (std::size_t k = 0; k < reference.sample.size(); ++k) {
    found.push_back(select_common(trajectory.sample[k], reference.sample[k]));
    wanted.push_back(select_common(reference.sample[k], trajectory.sample[k]));
  }
  auto relative = [&](auto values) {
    std::vector<double> a, b;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      for (double x : values(found[k])) a.push_back(x);
      for (double x : values(wanted[k])) b.push_back(x);
    }
    return coupling::relative_error(a, b);
  };
  Errors e;
  e.pressure = relative([](const Sample& s) { return s.pressure; });
  e.volume = relative([](const Sample& s) { return s.volume; });
  e.contact_force = relative([](const Sample& s) { return s.contact_force; });
  e.strain = relative([](const Sample& s) { return std::vector{s.strain}; });
  double sum = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const coupling::Distance d = coupling::aligned_distance(found[k].center, wanted[k].center);
    e.center_max = std::max(e.center_max, d.max);
    sum += d.rms * d.rms;
  }
  e.center_rms = std::sqrt(sum / static_cast<double>(wanted.size()));
  return e;
}

std::vector<PrecisionOutcome> run_study(WarmScene& scene, const PrecisionStudy& study,
                                        const std::function<void(const PrecisionOutcome&)>& done) {
  const Trajectory reference = scene.run(study.reference, study.window, study.samples);
  check(reference.failure.empty(),
        fmt::format("{}: {}: the reference failed: {}", scene.scene().name, study.title,
                    reference.failure),
        Exit::kCannotContinue);
  const int cells = static_cast<int>(reference.sample.front().center.size());
  std::vector<PrecisionOutcome> outcomes;
  for (const PrecisionSetting& setting : study.setting) {
    Trajectory t = scene.run(setting, study.window, study.samples);
    std::vector<double> cpu{t.cpu};
    while (t.failure.empty() && t.cpu < kLeastTimedCpu && cpu.size() < kMostRepeats)
      cpu.push_back(scene.run(setting, study.window, study.samples).cpu);
    std::ranges::sort(cpu);
    PrecisionOutcome e{setting, t.failure, cpu[cpu.size() / 2], study.window,
                       cells,   t.steps,   t.rejected,          t.cg_iterations};
    if (t.failure.empty()) {
      e.error = compute_errors(t, reference);
      e.main_error = scene.scene().axis == Vec3::Zero() ? e.error.pressure : e.error.strain;
      // One that exploded without being noticed is no result.
      if (!std::isfinite(e.main_error)) e.failure = "the error is not finite";
    }
    if (done) done(e);
    outcomes.push_back(e);
  }
  return outcomes;
}

const PrecisionOutcome* find_cheapest(const std::vector<PrecisionOutcome>& outcomes, double error) {
  const PrecisionOutcome* best = nullptr;
  for (const PrecisionOutcome& e : outcomes)
    if (e.failure.empty() && e.main_error <= error && (!best || e.cpu < best->cpu)) best = &e;
  return best;
}

}  // namespace acinus::bench
