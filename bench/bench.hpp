#pragma once
/// Measured speed and error of named cases.

#include <string>
#include <vector>

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Runs a benchmark and prints its table.
/// @return the process exit code: 1 if a row did not pass
/// @throws Error for an unknown name or a file that cannot be written
int run_bench(const std::string& name, const BenchOptions& options);

/// Names that run_bench knows.
std::vector<std::string> list_benches();

}  // namespace acinus::bench
