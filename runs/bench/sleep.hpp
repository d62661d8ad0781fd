#pragma once
/// What it saves that resting cells sleep, and what that does to the pressures.

#include "runs/bench/bench.hpp"
#include "runs/bench/table.hpp"

namespace acinus::runs {

/// The shipped lobule with resting cells, from its settled state on with and without sleep.
BenchTable bench_sleep(const BenchOptions& options);

}  // namespace acinus::runs
