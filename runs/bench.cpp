#include "runs/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/timing.hpp"
#include "coupling/step.hpp"
#include "runs/build_world.hpp"
#include "runs/scene/reader.hpp"

namespace acinus::runs {
namespace {

using Json = nlohmann::ordered_json;

/// What one case measured: the median over repetitions.
struct BenchRow {
  std::string name;
  int cells = 0;
  int steps = 0;
  double cpu_us_per_cell_step = 0;
  double wall_s = 0;
  double cg_per_step = 0;
  std::vector<StageTime> stages;  ///< of the median repetition
};

/// One case: a scene, how many steps warm it up, and how many are measured from the saved state.
struct BenchCase {
  std::string name, scene;
  int warm_up = 20, steps = 60, repeats = 5;
  std::function<void(coupling::World&)> prepare = [](coupling::World&) {};
};

constexpr const char* kDcm27 =
    R"({"name": "dcm27", "time": {"end": "12 h", "step": "120 s", "adaptive": false, "max_move": 0},
  "cell_types": {"cell": {}}, "cells": {"source": "clump", "model": "dcm", "count": 27, "spacing": 0.98, "jitter": 0.01},
  "motility": {"random": false}, "contact": {"quadrature": "QUADRATURE"}})";
constexpr const char* kCbm10k =
    R"({"name": "cbm10k", "time": {"end": "12 h", "step": "60 s", "adaptive": false, "max_move": 0},
  "solver": {"tolerance": 1e-6}, "friction": {"cbm_cbm": "5e8 N s/m^3"},
  "cell_types": {"cell": {}}, "cells": {"source": "clump", "model": "cbm", "count": COUNT, "spacing": 0.95, "jitter": 0.01},
  "motility": {"random": true}})";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Every cell grows from birth volume to twice that in a day, as in steady growth.
void grow(coupling::World& world) {
  for (Ramp& v : world.state.dcm.volume) v = {v.from, 2 * v.from, 0, 86400};
}

std::map<std::string, std::vector<BenchCase>> bench_cases() {
  return {
      {"dcm27",
       {{"27 growing DCM cells, 3-point", with(kDcm27, "QUADRATURE", "3-point"), 30, 60, 5, grow},
        {"27 growing DCM cells, nodes", with(kDcm27, "QUADRATURE", "nodes"), 30, 60, 5, grow}}},
      {"cbm10k", {{"10000 CBM cells", with(kCbm10k, "COUNT", "10000"), 20, 20, 5}}}};
}

BenchRow run_case(const BenchCase& c) {
  const Scene scene = parse_scene(c.scene, c.name);
  coupling::World world = build_world(scene, Ranks::serial()).world;
  c.prepare(world);
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  auto step = [&](coupling::World& w) {
    const coupling::StepResult r = coupling::advance(w, work, 1e9);
    check(r.accepted, c.name + ": a step failed: " + r.cause, Exit::kCannotContinue);
  };
  for (int k = 0; k < c.warm_up; ++k) step(world);
  const coupling::State saved = world.state;

  struct Sample {
    double cpu, wall;
    std::vector<StageTime> stages;
    std::int64_t cg;
  };
  std::vector<Sample> samples;
  for (int r = 0; r < c.repeats; ++r) {
    world.state = saved;
    work.timings.clear();
    const double cpu = cpu_seconds(), wall = wall_seconds();
    for (int k = 0; k < c.steps; ++k) step(world);
    samples.push_back({cpu_seconds() - cpu, wall_seconds() - wall, work.timings.stages(),
                       world.state.clock.cg_iterations - saved.clock.cg_iterations});
  }
  std::ranges::sort(samples, {}, &Sample::cpu);
  const Sample& median = samples[samples.size() / 2];
  BenchRow row;
  row.name = c.name;
  row.cells = dcm::count_cells(world.state.dcm) + static_cast<int>(world.state.cbm.n_cell());
  row.steps = c.steps;
  row.cpu_us_per_cell_step = 1e6 * median.cpu / (row.cells * static_cast<double>(c.steps));
  row.wall_s = median.wall;
  row.cg_per_step = static_cast<double>(median.cg) / c.steps;
  row.stages = median.stages;
  return row;
}

}  // namespace

std::vector<std::string> list_benches() {
  std::vector<std::string> names;
  for (const auto& [name, cases] : bench_cases()) names.push_back(name);
  return names;
}

int run_bench(const std::string& name, const std::string& json_file, int threads, int) {
  const auto all = bench_cases();
  const auto found = all.find(name);
  check(found != all.end(), fmt::format("bench {}: no such case; there are: {}", name,
                                        fmt::join(list_benches(), ", ")));
  if (threads <= 0) threads = omp_get_num_procs();
  omp_set_num_threads(threads);
  const Machine machine = describe_machine();
  fmt::print("{}  commit {}  {}  {}  {} threads; medians of repetitions from one saved state\n",
             name, ACINUS_GIT, machine.cpu_model, machine.instruction_set, threads);
  Json j = {{"name", name},
            {"commit", ACINUS_GIT},
            {"machine", machine.cpu_model},
            {"instruction_set", machine.instruction_set},
            {"threads", threads},
            {"rows", Json::array()}};
  for (const BenchCase& c : found->second) {
    const BenchRow row = run_case(c);
    fmt::print(
        "{:32s} {:6d} cells  {:9.2f} us CPU per cell-step  {:6.1f} CG iterations per step  {:.3f} "
        "s wall for {} steps\n",
        row.name, row.cells, row.cpu_us_per_cell_step, row.cg_per_step, row.wall_s, row.steps);
    Json stages = Json::object();
    for (const StageTime& s : row.stages) {
      const double us = 1e6 * s.cpu / (row.cells * static_cast<double>(row.steps));
      fmt::print("    {:20s} {:9.2f} us CPU per cell-step\n", s.name, us);
      stages[s.name] = us;
    }
    j["rows"].push_back({{"case", row.name},
                         {"cells", row.cells},
                         {"steps", row.steps},
                         {"cpu_us_per_cell_step", row.cpu_us_per_cell_step},
                         {"wall_s", row.wall_s},
                         {"cg_iterations_per_step", row.cg_per_step},
                         {"stage_cpu_us_per_cell_step", stages}});
  }
  if (!json_file.empty()) {
    std::ofstream out(json_file);
    out << j.dump(2) << '\n';
    out.close();
    check(out.good(), json_file + ": cannot be written. Choose another file.", Exit::kFileError);
  }
  return 0;
}

}  // namespace acinus::runs
