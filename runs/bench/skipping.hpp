#pragma once
/// What it saves to leave out what a scene does not need.

#include "runs/bench/bench.hpp"
#include "runs/bench/table.hpp"

namespace acinus::runs {

/// 27 growing cells with and without each skip, timed in turns.
BenchTable bench_skipping(const BenchOptions& options);

}  // namespace acinus::runs
