#pragma once
/// Tables of cell rules as PhysiCell writes them: one rule a line, comma or tab between columns.
///
/// Versions 2 and 3, 8 columns: cell type, signal, direction, behaviour, value at full response,
/// half-max, Hill power, applies to dead. Version 1 has the base value before the value at full
/// response. Version 0, 10 columns: cell type, behaviour, least, base and largest value, signal,
/// direction, half-max, Hill power, applies to dead. Lines that begin with // are comments.

#include <optional>
#include <string>
#include <vector>

namespace acinus::runs {

struct PhysiCellRule {
  int line = 0;  ///< from 1
  std::string cell_type, signal, behaviour;
  bool decreases = false;
  std::optional<double> base;  ///< without the signal; rates in 1/min, speeds in um/min
  double extreme = 0;          ///< at full response
  double half_max = 0, power = 0;
  bool dead = false;  ///< applies to dead cells
};

/// Reads a table.
/// @param source  name of the file, for messages
/// @throws Error with the number of the line: a number of columns that no version has, an empty
///         column, a text that is no number, an unknown direction, a value out of its range
std::vector<PhysiCellRule> parse_physicell_rules(const std::string& text,
                                                 const std::string& source);

}  // namespace acinus::runs
