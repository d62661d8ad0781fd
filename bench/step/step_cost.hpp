#pragma once
/// Cost of whole steps: after a warm-up the same steps are timed repeatedly from one saved state.

#include <optional>
#include <string>

#include "bench/output/bench_table.hpp"
#include "bench/step/step_runner.hpp"

namespace acinus::bench {

/// Cases of a clump of growing deformable cells and of adhering spheres.
StepCase dcm_case(int count, const std::string& quadrature, int steps,
                  std::optional<double> tolerance = {});
StepCase cbm_case(int count, int steps, int repeats);

BenchTable bench_dcm27(const BenchOptions& options);    ///< 27 growing deformable cells
BenchTable bench_dcm216(const BenchOptions& options);   ///< 216 growing deformable cells
BenchTable bench_cbm10k(const BenchOptions& options);   ///< 10,000 spheres
BenchTable bench_cbm100k(const BenchOptions& options);  ///< 100,000 spheres
BenchTable bench_cbm1m(const BenchOptions& options);    ///< a million spheres: memory
BenchTable bench_threads(const BenchOptions& options);  ///< one thread against two

}  // namespace acinus::bench
