#include "imaging/header_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acinus::imaging {

using geometry::trimmed;

void HeaderFields::add(std::string_view name, std::string_view value, std::size_t place) {
  const std::string key = geometry::lower_case(trimmed(name));
  const auto [entry, is_new] = field_.try_emplace(key, HeaderLine{trimmed(value), place});
  if (!is_new && entry->second.value != trimmed(value))
    file_.fail_at(place, fmt::format("the header says {} twice, {} and {}. {}", trimmed(name),
                                     geometry::in_quotes(entry->second.value),
                                     geometry::in_quotes(trimmed(value)), advice_));
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
    const std::string token = geometry::lower_case(t.substr(at, end - at));
    double value = std::nan("");
    if (token != "none" && !geometry::parse_double(token, value))
      fail(name, fmt::format("{} is no number", geometry::in_quotes(token)));
    out.push_back(value);
    at = end;
  }
  return out;
}

std::array<std::int64_t, 3> HeaderFields::sizes(const std::string& name) const {
  constexpr double kMost = 1e15;
  const std::vector<double> all = numbers(name);
  if (all.size() != 3) fail(name, fmt::format("{} needs three numbers", name));
  std::array<std::int64_t, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(all[k] >= 1 && all[k] <= kMost && all[k] == std::floor(all[k])))
      fail(name, fmt::format("{} has {}; whole numbers from 1 are needed", name, all[k]));
    out[k] = static_cast<std::int64_t>(all[k]);
  }
  return out;
}

std::optional<double> HeaderFields::number(const std::string& name) const {
  const std::vector<double> all = numbers(name);
  if (all.empty()) return std::nullopt;
  if (all.size() != 1 || std::isnan(all[0])) fail(name, fmt::format("{} needs one number", name));
  return all[0];
}

void HeaderFields::fail(const std::string& name, const std::string& what) const {
  file_.fail_at(has(name) ? field_.at(name).place : 0, what + ". " + advice_);
}

}  // namespace acinus::imaging
