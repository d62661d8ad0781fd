#include "bench/tissue/sleeping_lobule.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "coupling/measure/difference.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::bench {
namespace {

/// Rest of the cells before some begin to grow, s.
constexpr double kRestTime = 3600;
/// Length of the comparison and interval of pressure samples, s.
constexpr double kWindow = 3 * 3600, kSampleInterval = 1800;

/// Contact pressure and cytosol pressure by lineage, kPa.
using Pressures = std::map<std::int64_t, std::pair<double, double>>;

struct Record {
  double cpu = 0;    ///< s
  double awake = 0;  ///< mean share of awake cells
  double grows = 0;  ///< mean share of growing cells
  std::int64_t divisions = 0;
  std::vector<Pressures> pressure;
};

/// Runs a simulation until `end`, s since t = 0.
void run_until(coupling::Simulation& simulation, double end,
               const coupling::Observer& observer = {}) {
  const coupling::LoopResult result = simulation.run_until(end, observer);
  check(result.ok, "bench sleep: a step failed: " + result.last.cause, Exit::kCannotContinue);
}

Pressures measure(const coupling::World& world, coupling::Workspace& work) {
  coupling::observe(world, work);
  Pressures p;
  for (const coupling::CellMeasure& m : coupling::measure_cells(world, work))
    p[m.id] = {m.pressure, m.cytosol_pressure};
  return p;
}

/// One of the two compared runs.
struct Twin {
  coupling::Simulation simulation;
  Record record{};

  Twin(const coupling::World& start, bool sleep) : simulation(start) {
    simulation.world().params.sleep.enabled = sleep;
    simulation.resize();
  }

  /// Runs for a duration, s.
  void run(double duration) { run_until(simulation, simulation.time() + duration); }

  /// Runs for a duration (s) and records cost, shares and pressures.
  void run_recorded(double duration) {
    const coupling::State& s = simulation.world().state;
    const double cpu = cpu_seconds();
    const auto record_step = [&](const coupling::StepResult& step) {
      const int n = coupling::count_cells(s);
      const double share = step.step / kWindow / n;
      record.awake += share * (n - coupling::count_asleep(s));
      record.grows += share * static_cast<double>(std::ranges::count(s.cycle, coupling::Fate::kGrow,
                                                                     &coupling::Cycle::fate));
    };
    run_until(simulation, simulation.time() + duration, {.step = record_step});
    record.cpu += cpu_seconds() - cpu;
    record.pressure.push_back(measure(simulation.world(), simulation.work()));
    record.divisions = s.divisions;
  }
};

/// Relative error of one pressure over the cells of both records.
double relative_error(const Record& record, const Record& reference,
                      double std::pair<double, double>::*which) {
  std::vector<double> value, wanted;
  for (std::size_t k = 0; k < record.pressure.size(); ++k)
    for (const auto& [id, p] : reference.pressure[k]) {
      const auto found = record.pressure[k].find(id);
      if (found == record.pressure[k].end()) continue;
      value.push_back(found->second.*which);
      wanted.push_back(p.*which);
    }
  return coupling::relative_error(value, wanted);
}

}  // namespace

BenchTable bench_sleep(const BenchOptions&) {
  const runs::Scene scene = runs::read_scene(runs::scene_folder() + "/lobule_rest.json");
  coupling::Simulation start(runs::build_world(scene, Ranks::serial()).world);
  run_until(start, 0);
  Twin awake(start.world(), false), asleep(start.world(), true);
  for (Twin* twin : {&awake, &asleep}) twin->run(kRestTime);
  // In turns: the machine has slow and fast minutes.
  for (double t = 0; t < kWindow - 1; t += kSampleInterval)
    for (Twin* twin : {&awake, &asleep}) twin->run_recorded(kSampleInterval);
  const Record &reference = awake.record, &record = asleep.record;
  using Both = std::pair<double, double>;
  BenchRow row{"lobule with resting cells, 3 h",
               coupling::count_cells(start.world().state),
               {{"speedup", reference.cpu / record.cpu},
                {"pressure_error", relative_error(record, reference, &Both::first)},
                {"cytosol_pressure_error", relative_error(record, reference, &Both::second)},
                {"share_awake", record.awake},
                {"share_growing", record.grows},
                {"divisions", static_cast<double>(record.divisions)},
                {"cpu_awake_s", reference.cpu},
                {"cpu_asleep_s", record.cpu}}};
  print_row(row);
  return {row};
}

}  // namespace acinus::bench
