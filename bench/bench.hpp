#pragma once
/// Benchmarks of speed and error, by name.

#include <string>
#include <vector>

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Runs a benchmark and prints its table.
/// @return exit code: 1 if a row did not pass
/// @throws Error for an unknown name or an unwritable file
int run_bench(const std::string& name, const BenchOptions& options);

/// Names of all benchmarks.
std::vector<std::string> list_benches();

}  // namespace acinus::bench
