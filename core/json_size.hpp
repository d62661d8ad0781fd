#pragma once
/// Bounds of JSON texts, checked before parsing: parsers and visitors recurse once per level of
/// nesting, and some search the names of an object one by one.

#include <cstddef>
#include <string>
#include <string_view>

namespace acinus {

struct JsonBounds {
  int depth = 100;                 ///< levels of nesting
  std::size_t names = 4096;        ///< names in one object
  std::size_t values = 4'000'000;  ///< values in the whole text
  std::size_t bytes = 256'000'000;
};

/// Checks a text against the bounds by counting brackets and separators outside of strings and
/// comments, without recursion. Text that is not JSON may pass: the parser rejects it.
/// @return the bound that is broken, such as "nested deeper than 100 levels"; "" = none
std::string fault_of_json_size(std::string_view text, const JsonBounds& bounds = {});

}  // namespace acinus
