#pragma once
/// What processes that share a step send, and how long they wait.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// To be started by mpirun, or without it for the numbers of one process.
BenchTable bench_ranks(const BenchOptions& options);

}  // namespace acinus::bench
