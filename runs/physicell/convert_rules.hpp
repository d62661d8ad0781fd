#pragma once
/// Rules of PhysiCell as a scene.

#include <map>
#include <string>
#include <vector>

#include "runs/physicell/rules_table.hpp"

namespace acinus::runs {

/// Remark on one rule of the table.
struct RuleRemark {
  int line = 0;
  bool converted = false;
  std::string text;  ///< the rule in words, and what became of it
};

struct ConvertedRules {
  std::string scene;  ///< text of a scene file; values that no table has are marked in its comments
  std::vector<RuleRemark> remark;  ///< in the order of the table
  std::size_t n_converted = 0;
};

/// Base values by "BEHAVIOUR" or "CELL TYPE:BEHAVIOUR", for tables without them.
using BaseValues = std::map<std::string, double>;

/// Converts what acinus has: substances, pressure, volume and contacts that act on cycle entry,
/// apoptosis, necrosis, migration speed, adhesion, secretion and uptake.
/// @param name           of the scene
/// @param source         name of the table, for its description
/// @param unit_pressure  kPa that PhysiCell's pressure 1 stands for, which has no unit; 0: unknown,
///                       rules of pressure are left out
ConvertedRules convert_physicell_rules(const std::vector<PhysiCellRule>& rules,
                                       const BaseValues& base, const std::string& name,
                                       const std::string& source, double unit_pressure = 0);

/// Base values from "NAME=VALUE".   @throws Error
BaseValues parse_base_values(const std::vector<std::string>& texts);

/// Converts a file into FOLDER/NAME.json, NAME being that of the table.
/// @return the remarks; `scene` is the path of the file written
/// @throws Error: a bad table, a base value that names nothing in it, a file that exists already
///         (kFileError)
ConvertedRules write_physicell_scene(const std::string& table, const std::string& folder,
                                     const BaseValues& base, double unit_pressure = 0);

}  // namespace acinus::runs
