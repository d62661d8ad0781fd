#include "bench/step/skipping.hpp"

#include <algorithm>
#include <string>

#include "bench/step/packed_clump.hpp"
#include "bench/step/step_runner.hpp"
#include "dcm/contact/contact_workspace.hpp"

namespace acinus::bench {
namespace {

StepCase clump_case(const std::string& quadrature, double skin, double local_area_modulus,
                    bool always_coarse) {
  return {.name = "27 growing DCM cells, " + quadrature,
          .scene = packed_clump_text({.count = 27,
                                      .quadrature = quadrature,
                                      .skin = skin,
                                      .local_area_modulus = local_area_modulus}),
          .warm_up = 30,
          .steps = 30,
          .grows = true,
          .always_coarse = always_coarse};
}

/// CPU time per step without a skip relative to that with it.
BenchRow compare(const std::string& what, const StepCase& with, const StepCase& without) {
  constexpr std::size_t kTurns = 7;
  StepRunner fast(with), slow(without);
  std::vector<double> gain, cost;
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const double cpu = fast.measure().cpu;
    gain.push_back(slow.measure().cpu / cpu);
    cost.push_back(1e6 * cpu / (fast.cells() * with.steps));
  }
  std::ranges::sort(gain);
  std::ranges::sort(cost);
  BenchRow row{what + ", " + with.name,
               fast.cells(),
               {{"gain", gain[kTurns / 2]},
                {"gain_least", gain.front()},
                {"gain_most", gain.back()},
                {"cpu_us_per_cell_step", cost[kTurns / 2]}}};
  print_row(row);
  return row;
}

/// Share of listed contact points that are searched; the others are skipped since nothing near them
/// moved far enough.
BenchRow count_searches(const StepCase& c) {
  StepRunner runner(c);
  runner.measure();
  const dcm::ContactWorkspace& w = runner.work().dcm;
  const auto listed = static_cast<double>(w.points_listed),
             searched = static_cast<double>(w.points_seen);
  BenchRow row{"points that cannot touch within the step, " + c.name,
               runner.cells(),
               {{"points_listed_per_search", listed / w.searches},
                {"points_searched_per_search", searched / w.searches},
                {"share_skipped", 1 - searched / listed}}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_skipping(const BenchOptions&) {
  BenchTable table;
  for (const char* quadrature : {"3-point", "nodes"}) {
    const StepCase usual = clump_case(quadrature, kClumpSkin, 0, false);
    constexpr double kNoSkin = 0.01;      // um: lists are made at nearly every step
    constexpr double kNoModulus = 1e-15;  // N/m: computed without effect
    table.push_back(
        compare("contact lists with skin", usual, clump_case(quadrature, kNoSkin, 0, false)));
    table.push_back(compare("a term whose coefficient is zero", usual,
                            clump_case(quadrature, kClumpSkin, kNoModulus, false)));
    table.push_back(
        compare("coarse space of easy solves", usual, clump_case(quadrature, kClumpSkin, 0, true)));
    table.push_back(count_searches(usual));
  }
  return table;
}

}  // namespace acinus::bench
