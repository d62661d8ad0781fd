#pragma once
/// Communication and waiting times of processes that share a step.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Traffic per step. Started by mpirun, or without it for a single process.
BenchTable bench_ranks(const BenchOptions& options);

}  // namespace acinus::bench
