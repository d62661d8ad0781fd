#pragma once
/// Communication, waiting times and memory of processes that share a step.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Traffic per step. Started by mpirun, or without it for a single process.
BenchTable bench_ranks(const BenchOptions& options);

/// Memory of a process by kind, and bytes of collective calls by line, in cases that grow with the
/// number of processes. Started as bench_ranks.
BenchTable bench_rank_memory(const BenchOptions& options);

}  // namespace acinus::bench
