#include "core/json_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace acinus {
namespace {

/// End of the token that begins at `at`: a text in quotes, a comment, or one character.
std::size_t skip(std::string_view text, std::size_t at) {
  const auto end_of = [&](std::string_view mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string_view::npos ? text.size() : found + mark.size();
  };
  if (text[at] == '/' && text.substr(at, 2) == "//") return end_of("\n", at);
  if (text[at] == '/' && text.substr(at, 2) == "/*") return end_of("*/", at + 2);
  if (text[at] != '"') return at + 1;
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

}  // namespace

std::string fault_of_json_size(std::string_view text, const JsonBounds& bounds) {
  if (text.size() > bounds.bytes)
    return fmt::format("{} bytes of JSON; at most {} are read", text.size(), bounds.bytes);
  std::vector<std::size_t> names;  // of the objects that are open
  std::size_t values = 0;
  for (std::size_t at = 0; at < text.size(); at = skip(text, at)) {
    switch (text[at]) {
      case '{':
      case '[':
        if (std::ssize(names) >= bounds.depth)
          return fmt::format("nested deeper than {} levels", bounds.depth);
        names.push_back(0);
        ++values;
        break;
      case '}':
      case ']':
        if (!names.empty()) names.pop_back();
        break;
      case ':':
        if (!names.empty() && ++names.back() > bounds.names)
          return fmt::format("more than {} names in one object", bounds.names);
        break;
      case ',':
        ++values;
        break;
      default:
        break;
    }
    if (values > bounds.values) return fmt::format("more than {} values", bounds.values);
  }
  return "";
}

}  // namespace acinus
