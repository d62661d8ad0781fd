#pragma once
/// Long table, one value a row, as an HDF5 file. The same rows give the same bytes.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace acinus::io {

struct TidyColumn {
  std::string name;
  std::string unit;  ///< of numbers
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> value;
};

/// Writes one dataset per column, all of the same length; numbers with the attribute `unit`. The
/// file appears whole or not at all.   @throws Error(kFileError)
void write_tidy_table(const std::string& path, const std::vector<TidyColumn>& columns);

}  // namespace acinus::io
