#include "bench/step/nucleus_cost.hpp"

#include <algorithm>
#include <string>

#include "bench/step/packed_clump.hpp"
#include "bench/step/step_runner.hpp"

namespace acinus::bench {
namespace {

constexpr int kSteps = 30;

StepCase clump_case(const std::string& name, const std::string& nucleus) {
  return {.name = name,
          .scene = packed_clump_text(
              {.count = 27, .quadrature = "nodes", .skin = kClumpSkin, .nucleus = nucleus}),
          .warm_up = 30,
          .steps = kSteps,
          .grows = true};
}

BenchRow compare(StepRunner& without, const std::string& name, const std::string& nucleus) {
  constexpr std::size_t kTurns = 7;
  StepRunner with(clump_case(name, nucleus));
  std::vector<double> ratio, cost;
  double iterations = 0, iterations_without = 0;
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const StepSample plain = without.measure(), own = with.measure();
    ratio.push_back(own.cpu / plain.cpu);
    cost.push_back(1e6 * own.cpu / (with.cells() * kSteps));
    iterations = static_cast<double>(own.cg) / kSteps;
    iterations_without = static_cast<double>(plain.cg) / kSteps;
  }
  std::ranges::sort(ratio);
  std::ranges::sort(cost);
  BenchRow row{name,
               with.cells(),
               {{"cpu_over_that_without", ratio[kTurns / 2]},
                {"least", ratio.front()},
                {"most", ratio.back()},
                {"cpu_us_per_cell_step", cost[kTurns / 2]},
                {"cg_iterations_per_step", iterations},
                {"cg_iterations_without", iterations_without}}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_nucleus(const BenchOptions&) {
  StepRunner without(clump_case("27 growing DCM cells, nodes", "null"));
  return {
      compare(without, "nucleus of no stiffness", R"({"young": "0 kPa", "bulk_modulus": "0 Pa"})"),
      compare(without, "42 nodes, half the radius", "{}"),
      compare(without, "42 nodes, links of 0.1 kPa", R"({"link_young": "0.1 kPa"})"),
      compare(without, "42 nodes, 0.8 of the radius, in contact", R"({"size": 0.8})"),
      compare(without, "162 nodes, links of 0.1 kPa",
              R"({"nodes": 162, "link_young": "0.1 kPa"})")};
}

}  // namespace acinus::bench
