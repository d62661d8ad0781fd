#pragma once
/// Savings by skipping work that a scene does not need.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// 27 growing cells with and without each skip, timed in turns.
BenchTable bench_skipping(const BenchOptions& options);

}  // namespace acinus::bench
