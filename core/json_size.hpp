#pragma once
/// Bounds of JSON texts, checked before they are parsed: parsers and visitors of their trees call
/// themselves once a level, and some look up names one after the other.

#include <cstddef>
#include <string>
#include <string_view>

namespace acinus {

struct JsonBounds {
  int depth = 100;                 ///< nesting
  std::size_t names = 4096;        ///< of one object
  std::size_t values = 4'000'000;  ///< in all
  std::size_t bytes = 256'000'000;
};

/// Counts brackets and separators outside of texts and comments, without recursion. What is no JSON
/// may pass: the parser says so.
/// @return which bound is broken, "nested deeper than 100 levels"; "" = none
std::string fault_of_json_size(std::string_view text, const JsonBounds& bounds = {});

}  // namespace acinus
