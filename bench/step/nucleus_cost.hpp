#pragma once
/// What a nucleus costs.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// CPU time of a step of 27 growing cells with nuclei over that without, timed in turns.
BenchTable bench_nucleus(const BenchOptions& options);

}  // namespace acinus::bench
