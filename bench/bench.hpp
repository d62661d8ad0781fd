#pragma once
/// Measured speed and error of named cases.

#include <string>
#include <vector>

namespace acinus::bench {

struct BenchOptions {
  std::string json_file;  ///< rows are also written here; "" = not
  std::string folder;     ///< for plots and scenes of benchmarks that write them; "" = not
  int threads = 0;        ///< 0 = all cores
  int seeds = 3;          ///< repetitions with different random numbers, for cases that have any
  int first = 1;          ///< the first of these seeds
  bool life = false;      ///< cells of random scenes grow, divide and die
};

/// Runs a benchmark and prints its table.
/// @return the process exit code: 1 if a row did not pass
/// @throws Error for an unknown name or a file that cannot be written
int run_bench(const std::string& name, const BenchOptions& options);

/// Names that run_bench knows.
std::vector<std::string> list_benches();

}  // namespace acinus::bench
