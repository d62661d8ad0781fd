#include "bench/output/bench_table.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace acinus::bench {

void print_row(const BenchRow& row) {
  fmt::print("{}  ({} cells)\n", row.name, row.cells);
  for (const auto& [key, value] : row.value) fmt::print("    {:40s} {:12.4g}\n", key, value);
  std::fflush(stdout);
}

}  // namespace acinus::bench
