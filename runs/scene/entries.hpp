#pragma once
/// The lines of a registry: what is known of each key, as text.

#include <functional>
#include <string>
#include <vector>

#include "core/units/units.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// One line of the registry.
struct Entry {
  std::string path;        ///< "cell_types.<name>.dcm.nodes"
  std::string short_path;  ///< "cell.dcm.nodes", what error messages print
  std::string type;        ///< "quantity", "number", "whole number", "true or false", "text", ...
  Dimension dimension;
  std::string unit;     ///< "" = none
  std::string initial;  ///< the default as JSON text; "" = required or none
  std::string range;    ///< allowed values as text; "" = any
  std::string meaning;
  std::string symbol;
  std::string condition;  ///< "kind = sphere": exists only then
  bool is_block = false;  ///< an object, list or map, not a value
};

/// The lines of any registry, in its order, below that of the key `extends`.
/// @param extends  meaning of that key
std::vector<Entry> collect_entries(const char* extends,
                                   const std::function<void(Visitor&)>& describe);

/// Every key of a scene, in canonical order; built once.
const std::vector<Entry>& all_entries();

}  // namespace acinus::runs
