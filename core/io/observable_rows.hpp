#pragma once
/// The group /observables of a run file: what was measured, one row per written frame.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace acinus::io {

struct ObservableRows {
  struct Column {
    std::string unit;           ///< "1" = dimensionless
    std::vector<double> value;  ///< [row], finite
  };
  std::vector<double> time_s;            ///< [row]
  std::map<std::string, Column> column;  ///< by name
};

/// The finished rows, also while the run still goes on; nothing if the file has no such group.
/// @throws Error(kFileError) if the file cannot be read
std::optional<ObservableRows> read_observable_rows(const std::string& run_file);

}  // namespace acinus::io
