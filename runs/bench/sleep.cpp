#include "runs/bench/sleep.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/timing.hpp"
#include "coupling/difference.hpp"
#include "coupling/life/life.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/measure.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/start_up.hpp"
#include "coupling/step/stages.hpp"
#include "runs/build_world.hpp"
#include "runs/scene/library.hpp"
#include "runs/scene/reader.hpp"

namespace acinus::runs {
namespace {

/// The scene's cells rest for so long, s, before some of them begin to grow.
constexpr double kSettle = 3600;
/// What is compared, s, and how often pressures are looked at.
constexpr double kWindow = 3 * 3600, kEvery = 1800;

/// By lineage, kPa: contact pressure and that of the cytosol.
using Pressures = std::map<std::int64_t, std::pair<double, double>>;

struct Record {
  double cpu = 0;    ///< s
  double awake = 0;  ///< mean share of the cells
  double grows = 0;  ///< the same of those that grow
  std::int64_t divisions = 0;
  std::vector<Pressures> pressure;
};

void make_step(coupling::World& world, coupling::Workspace& work, double limit) {
  const coupling::StepResult r = coupling::advance(world, work, limit);
  check(r.accepted, "bench sleep: a step failed: " + r.cause, Exit::kCannotContinue);
}

/// The scene at the end of its start-up.
coupling::World start_up(coupling::World world) {
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  while (world.state.clock.phase != coupling::Phase::kRun) {
    make_step(world, work, coupling::time_to_phase_event(world));
    coupling::update_phase(world, work);
  }
  coupling::begin_life(world);
  return world;
}

Pressures measure(const coupling::World& world, coupling::Workspace& work) {
  coupling::observe(world, work);
  Pressures p;
  for (const coupling::CellMeasure& m : coupling::measure_cells(world, work))
    p[m.id] = {m.pressure, m.cytosol_pressure};
  return p;
}

/// One of the two runs.
struct Twin {
  coupling::World world;
  coupling::Workspace work{};
  Record record{};

  Twin(const coupling::World& start, bool sleep) : world(start) {
    world.params.sleep.enabled = sleep;
    coupling::size_workspace(world, work);
  }

  /// Steps for a while; records it if wanted.
  void run(double duration, bool counts) {
    const coupling::State& s = world.state;
    const double end = s.clock.time + duration, cpu = cpu_seconds();
    while (s.clock.time < end - 1e-6) {  // sums of steps are not exact
      const double before = s.clock.time;
      make_step(world, work, std::min(end - s.clock.time, coupling::time_to_event(world)));
      coupling::live(world, work);
      if (!counts) continue;
      const int n = coupling::count_cells(s);
      const double share = (s.clock.time - before) / kWindow / n;
      record.awake += share * (n - coupling::count_asleep(s));
      record.grows += share * static_cast<double>(std::ranges::count(s.cycle, coupling::Fate::kGrow,
                                                                     &coupling::Cycle::fate));
    }
    if (!counts) return;
    record.cpu += cpu_seconds() - cpu;
    record.pressure.push_back(measure(world, work));
    record.divisions = s.divisions;
  }
};

/// Of the cells that both have.
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
  const Scene scene = read_scene(scene_folder() + "/lobule_rest.json");
  const coupling::World start = start_up(build_world(scene, Ranks::serial()).world);
  Twin awake(start, false), asleep(start, true);
  for (Twin* twin : {&awake, &asleep}) twin->run(kSettle, false);
  // In turns: the machine has slow and fast minutes.
  for (double t = 0; t < kWindow - 1; t += kEvery)
    for (Twin* twin : {&awake, &asleep}) twin->run(kEvery, true);
  const Record &reference = awake.record, &record = asleep.record;
  using Both = std::pair<double, double>;
  BenchRow row{"lobule with resting cells, 3 h",
               coupling::count_cells(start.state),
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

}  // namespace acinus::runs
