#pragma once
/// Lines of a registry: properties of each key, those taken over from its block included.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units/units.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Line of the registry.
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
  std::string condition;             ///< "kind = sphere": exists only then
  bool is_block = false;             ///< an object, list or map, not a value
  bool is_file = false;              ///< a text that is a path of a file, or one of the choices
  std::vector<std::string> choices;  ///< allowed texts; empty = any
  Affects affects = Affects::kStart;
  bool compared = true;
  bool softens = false;
  InLaw in_law = InLaw::kNo;
  std::string law_name;
};

/// Lines of any registry, in its order, below that of the key `extends`.
/// @param extends  meaning of that key
/// @param prefix   put in front of every path, as "study."
std::vector<Entry> collect_entries(const char* extends,
                                   const std::function<void(Visitor&)>& describe,
                                   const std::string& prefix = "");

/// Every key of a scene, in canonical order; built once.
const std::vector<Entry>& all_entries();

/// Names and numbers along a JSON pointer or a dotted path: {"walls", "0", "point"}.
std::vector<std::string> names_in_path(std::string_view path);

/// Entry of the scene key at a JSON pointer or a dotted path, "/walls/0/point" or
/// "cell_types.hepatocyte.radius"; null if there is no such key.
const Entry* find_entry(std::string_view path);

/// Entry of the innermost key or block of a scene on the way along a path: that of a vector for its
/// components, that of a block for keys that the registry does not have. Null if there is none.
const Entry* find_innermost_entry(std::string_view path);

}  // namespace acinus::runs
