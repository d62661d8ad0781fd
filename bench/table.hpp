#pragma once
/// What benchmarks measured, ready to print and to write.

#include <string>
#include <utility>
#include <vector>

namespace acinus::bench {

/// One line: a case and its figures. Names of figures are the keys of the JSON rows.
struct BenchRow {
  std::string name;
  int cells = 0;
  std::vector<std::pair<std::string, double>> value;
  bool passed = true;  ///< false: a case that checks something found it broken
};

using BenchTable = std::vector<BenchRow>;

/// Prints one row as `name  key value  key value ...`.
void print_row(const BenchRow& row);

}  // namespace acinus::bench
