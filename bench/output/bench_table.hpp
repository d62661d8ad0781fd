#pragma once
/// Options of benchmarks and the tables of their results, ready to print and to write.

#include <string>
#include <utility>
#include <vector>

namespace acinus::bench {

struct BenchOptions {
  std::string json_file;  ///< rows are also written here; "" = not
  std::string folder;     ///< for plots and scenes of benchmarks that write them; "" = not
  int threads = 0;        ///< 0 = all cores
  int seeds = 3;          ///< repetitions with different random numbers, for cases that have any
  int first = 1;          ///< the first of these seeds
  bool life = false;      ///< cells of random scenes grow, divide and die
  double radius = 12;     ///< um, of the cells that laws of stiffness are judged with
  double stiffness = 1;   ///< factor on the moduli of these cells
};

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
