#include "runs/study/scene_value.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

std::vector<std::string> split(std::string path) {
  std::ranges::replace(path, '/', '.');
  std::vector<std::string> parts(1);
  for (char c : path) {
    if (c == '.') {
      if (!parts.back().empty()) parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// True if a path matches a key with placeholders: "cell_types.<name>.radius" matches
/// "cell_types.hepatocyte.radius".
bool fits(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
  return std::ranges::equal(pattern, path, [](const std::string& a, const std::string& b) {
    return a == b || a.front() == '<';
  });
}

}  // namespace

std::optional<std::string> unit_of_key(const std::string& key) {
  const std::vector<std::string> path = split(key);
  for (const Entry& entry : all_entries())
    if (fits(split(entry.path), path)) {
      if (entry.type != "quantity" && entry.type != "number" && entry.type != "whole number")
        return std::nullopt;
      return entry.unit.empty() ? "1" : entry.unit;
    }
  return std::nullopt;
}

std::optional<double> value_of_key(const Scene& scene, const std::string& key) {
  const nlohmann::json root = nlohmann::json::parse(scene.resolved_json);
  const nlohmann::json* at = &root;
  for (const std::string& part : split(key)) {
    if (at->is_array()) {
      std::size_t index = 0;
      const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), index);
      if (code != std::errc() || index >= at->size()) return std::nullopt;
      at = &(*at)[index];
    } else if (at->is_object() && at->contains(part)) {
      at = &(*at)[part];
    } else {
      return std::nullopt;
    }
  }
  if (at->is_number()) return at->get<double>();
  if (!at->is_string()) return std::nullopt;
  const std::string text = *at;  // "0.3 nN", in the unit of the registry
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc()) return std::nullopt;
  return value;
}

}  // namespace acinus::runs
