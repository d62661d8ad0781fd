#pragma once
/// Options and result tables of benchmarks.

#include <string>
#include <utility>
#include <vector>

namespace acinus::bench {

/// Options of all benchmarks.
struct BenchOptions {
  std::string json_file;  ///< JSON file for the rows; "" = none
  std::string
      csv_file;        ///< result file, or folder of result files, to append the rows to; "" = none
  std::string folder;  ///< folder for plots and scenes; "" = none
  int threads = 0;     ///< 0 = all cores
  int seeds = 3;       ///< number of random repetitions
  int first = 1;       ///< seed of the first repetition
  bool life = false;   ///< growth, division and death in random scenes
  std::string law;     ///< contact.law of random scenes; "": drawn
  double radius = 12;  ///< of the cells in tests of stiffness laws, um
  double stiffness = 1;  ///< factor on the moduli of these cells
};

/// Row of a table: a case with its figures. Names of figures are those of JSON and
/// result files and end in their unit (result_file.hpp).
struct BenchRow {
  std::string name;
  int cells = 0;
  std::vector<std::pair<std::string, double>> value;
  bool passed = true;  ///< false: a checked property is violated
};

using BenchTable = std::vector<BenchRow>;

/// Prints a row as `name  key value  key value ...`.
void print_row(const BenchRow& row);

}  // namespace acinus::bench
