#pragma once
/// What it saves to leave out what a scene does not need.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// 27 growing cells with and without each skip, timed in turns.
BenchTable bench_skipping(const BenchOptions& options);

}  // namespace acinus::bench
