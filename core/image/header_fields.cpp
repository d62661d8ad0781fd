#include "core/image/header_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acinus::image {

std::string trimmed(std::string_view text) {
  constexpr const char* kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == text.npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

void HeaderFields::add(std::string_view name, std::string_view value, std::size_t place) {
  field_[mesh::lower_case(trimmed(name))] = {trimmed(value), place};
}

std::string HeaderFields::text(const std::string& name) const {
  return has(name) ? field_.at(name).value : std::string();
}

std::vector<double> HeaderFields::numbers(const std::string& name) const {
  std::vector<double> out;
  std::string t = text(name);
  std::ranges::replace_if(
      t, [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::size_t at = 0;
  while ((at = t.find_first_not_of(" \t", at)) != t.npos) {
    const std::size_t end = std::min(t.find_first_of(" \t", at), t.size());
    const std::string token = mesh::lower_case(t.substr(at, end - at));
    double value = std::nan("");
    if (token != "none" && !mesh::parse_double(token, value))
      fail(name, fmt::format("{} is no number", mesh::in_quotes(token)));
    out.push_back(value);
    at = end;
  }
  return out;
}

void HeaderFields::fail(const std::string& name, const std::string& what) const {
  file_.fail_at(has(name) ? field_.at(name).place : 0, what + ". " + advice_);
}

}  // namespace acinus::image
