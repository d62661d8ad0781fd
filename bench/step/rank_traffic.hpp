#pragma once
/// Traffic and waiting times of processes that share a step.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// To be started by mpirun, or without it for the numbers of one process.
BenchTable bench_ranks(const BenchOptions& options);

}  // namespace acinus::bench
