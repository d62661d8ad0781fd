#pragma once
/// Result files: rows of benchmarks as CSV, one figure a line. The pages of measurements are made
/// from them (bench/results/README.md).

#include <string>
#include <string_view>

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Origin of the rows of one benchmark run.
struct ResultOrigin {
  std::string command;          ///< command line that repeats the measurement
  std::string commit;           ///< of the program
  std::string machine;          ///< model of the processor
  std::string instruction_set;  ///< widest one used
  int threads = 1;
  std::string date;  ///< day of the start, UTC, as 2026-11-28
};

/// Command line that repeats a benchmark: its name, threads and all options that differ from their
/// defaults, without output files.
/// @param threads  threads used
std::string describe_command(const std::string& name, const BenchOptions& options, int threads);

/// Unit that the name of a figure carries: "s" of `cpu_s`, "us" of `cpu_us_per_cell_step`; "" if it
/// carries none. What follows "_per_" belongs to the name.
std::string unit_of_figure(std::string_view figure);

/// Prepares a result file before the measurement starts, so that a fault is found early. A new or
/// empty file gets the header line.
/// @param path  file, or folder for a file named by date and machine
/// @return the file
/// @throws Error for a file that cannot be written or has other columns
std::string prepare_result_file(const std::string& path, const ResultOrigin& origin);

/// Appends all figures of a table, with the number of cells of a case that has any, to a prepared
/// file.
/// @throws Error(kFileError)
void append_results(const std::string& file, const ResultOrigin& origin, const BenchTable& table);

}  // namespace acinus::bench
