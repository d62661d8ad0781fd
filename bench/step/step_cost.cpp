#include "bench/step/step_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/step/packed_clump.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::bench {
namespace {

/// Scene text of a clump of spheres. Cell-cell friction is `ratio` times that with the medium.
std::string cbm_clump(int count, double ratio) {
  return fmt::format(
      R"({{"name": "cbm", "time": {{"end": "12 h", "step": "60 s", "adaptive": false, "max_move": 0}},
  "solver": {{"tolerance": 1e-6}}, "friction": {{"cbm_cbm": "{} N s/m^3"}},
  "cell_types": {{"cell": {{}}}},
  "cells": {{"source": "clump", "model": "cbm", "count": {}, "spacing": 0.95, "jitter": 0.01}},
  "motility": {{"random": true}}}})",
      5e8 * ratio, count);
}

BenchRow measure_case(const StepCase& c) {
  StepRunner runner(c);
  const StepSample s = runner.measure_median();
  const double cell_steps = runner.cells() * static_cast<double>(c.steps);
  BenchRow row{c.name,
               runner.cells(),
               {{"cpu_us_per_cell_step", 1e6 * s.cpu / cell_steps},
                {"cg_iterations_per_step", static_cast<double>(s.cg) / c.steps},
                {"contacts_per_cell", runner.contacts_per_cell()},
                {"bytes_per_cell", runner.bytes_per_cell()},
                {"wall_s", s.wall}}};
  for (const StageTime& t : s.stages) {
    std::string key = t.name + "_us";
    std::ranges::replace(key, ' ', '_');
    row.value.emplace_back(key, 1e6 * t.cpu / cell_steps);
    if (t.name == "solve")
      row.value.emplace_back("solve_us_per_iteration",
                             1e6 * t.cpu / (static_cast<double>(s.cg) * runner.cells()));
  }
  print_row(row);
  return row;
}

}  // namespace

StepCase dcm_case(int count, const std::string& quadrature, int steps,
                  std::optional<double> tolerance) {
  return {
      fmt::format("{} growing DCM cells, {}{}", count, quadrature,
                  tolerance ? fmt::format(", CG {:g}", *tolerance) : ""),
      packed_clump_text(
          {.count = count, .quadrature = quadrature, .skin = kClumpSkin, .tolerance = tolerance}),
      30,
      steps,
      5,
      true};
}
StepCase cbm_case(int count, int steps, int repeats) {
  return {fmt::format("{} CBM cells, friction ratio 1", count),
          cbm_clump(count, 1),
          20,
          steps,
          repeats,
          false};
}

BenchTable bench_dcm27(const BenchOptions&) {
  // The loosest solver whose pressure is still within 2 % (docs/developers/work_precision.md)
  // beside the usual.
  return {measure_case(dcm_case(27, "3-point", 60)), measure_case(dcm_case(27, "nodes", 60)),
          measure_case(dcm_case(27, "3-point", 60, 1e-2)),
          measure_case(dcm_case(27, "nodes", 60, 1e-2))};
}
BenchTable bench_dcm216(const BenchOptions&) {
  return {measure_case(dcm_case(216, "3-point", 20)), measure_case(dcm_case(216, "nodes", 20))};
}
BenchTable bench_cbm10k(const BenchOptions&) {
  StepCase strong{"10000 CBM cells, friction ratio 100", cbm_clump(10000, 100), 20, 20, 3, false};
  return {measure_case(cbm_case(10000, 20, 5)), measure_case(strong)};
}
BenchTable bench_cbm100k(const BenchOptions&) {
  StepCase strong{"100000 CBM cells, friction ratio 100", cbm_clump(100000, 100), 10, 5, 3, false};
  return {measure_case(cbm_case(100000, 10, 3)), measure_case(strong)};
}
BenchTable bench_cbm1m(const BenchOptions&) {
  StepCase c = cbm_case(1000000, 2, 1);
  c.warm_up = 2;
  c.once = true;
  return {measure_case(c)};
}

BenchTable bench_threads(const BenchOptions&) {
  BenchTable table;
  for (const StepCase& c :
       {dcm_case(216, "3-point", 20), dcm_case(216, "nodes", 20), cbm_case(100000, 5, 1)}) {
    set_threads(1);
    StepRunner runner(c);
    std::vector<double> ratio;
    bool same = true;
    for (int r = 0; r < 5; ++r) {
      set_threads(1);
      const StepSample one = runner.measure();
      set_threads(2);
      const StepSample two = runner.measure();
      ratio.push_back(one.wall / two.wall);
      same = same && one.hash == two.hash;
    }
    std::ranges::sort(ratio);
    table.push_back({c.name,
                     runner.cells(),
                     {{"speedup", ratio[ratio.size() / 2]},
                      {"speedup_least", ratio.front()},
                      {"speedup_most", ratio.back()},
                      {"same_bits", same ? 1.0 : 0.0}}});
    print_row(table.back());
  }
  return table;
}

}  // namespace acinus::bench
