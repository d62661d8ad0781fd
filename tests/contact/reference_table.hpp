#pragma once
/// Reads a reference table: comma separated, first line the header, text in double quotes may hold
/// commas.

#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>
#include "tests/paths.hpp"

namespace acinus::test {

using Row = std::vector<std::string>;

inline Row split_row(const std::string& line) {
  Row row(1);
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"') {
      quoted = !quoted;
    } else if (letter == ',' && !quoted) {
      row.emplace_back();
    } else if (letter != '\r') {
      row.back() += letter;
    }
  }
  return row;
}

/// Rows of tests/data/reference/`name` without the header.
inline std::vector<Row> read_reference(const std::string& name) {
  const std::string path = data_path("reference/" + name);
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    if (!line.empty()) rows.push_back(split_row(line));
  }
  return rows;
}

inline double number(const Row& row, std::size_t column) { return std::stod(row.at(column)); }

// The tables are in SI, the program in um, s, nN.
inline constexpr double kMetre = 1e6, kNewton = 1e9, kPascal = 1e-3, kJoulePerSquareMetre = 1e3;

inline double relative(double value, double exact) {
  return value == exact
             ? 0.0
             : (value > exact ? value - exact : exact - value) / (exact < 0.0 ? -exact : exact);
}

}  // namespace acinus::test
