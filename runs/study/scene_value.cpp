#include "runs/study/scene_value.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "runs/scene/entries.hpp"

namespace acinus::runs {
std::optional<std::string> unit_of_key(const std::string& key) {
  const Entry* entry = find_entry(key);
  const bool is_number =
      entry != nullptr && (entry->type == "quantity" || entry->type == "number" ||
                           entry->type == "number or quantity" || entry->type == "whole number");
  if (!is_number) return std::nullopt;
  return entry->unit.empty() ? "1" : entry->unit;
}

std::optional<double> value_of_key(const Scene& scene, const std::string& key) {
  const nlohmann::json root = nlohmann::json::parse(scene.resolved_json);
  const nlohmann::json* at = &root;
  for (const std::string& part : names_in_path(key)) {
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
