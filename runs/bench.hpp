#pragma once
/// Measured speed and error of named cases.

#include <string>
#include <vector>

namespace acinus::runs {

/// Runs a benchmark and prints its table.
/// @param json_file  also written there as JSON; "" = not
/// @param threads    0 = all cores
/// @param seeds      repetitions with different random numbers, for cases that have any
/// @return the process exit code
/// @throws Error for an unknown name or a file that cannot be written
int run_bench(const std::string& name, const std::string& json_file, int threads, int seeds);

/// Names that run_bench knows.
std::vector<std::string> list_benches();

}  // namespace acinus::runs
