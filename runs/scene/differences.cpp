#include "runs/scene/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

using Json = nlohmann::json;

/// True for the default of a key, and for a block all of whose keys have theirs.
bool is_default(const std::string& pointer, const Json& value) {
  if (value.is_object())
    return std::ranges::all_of(value.items(), [&](const auto& member) {
      return is_default(pointer + "/" + member.key(), member.value());
    });
  const Entry* key = find_entry(pointer);
  return key != nullptr && !key->initial.empty() &&
         Json::parse(key->initial, nullptr, false) == value;
}

}  // namespace

std::vector<std::string> list_scene_differences(
    const std::string& then_text, const std::string& now_text,
    const std::function<bool(const std::string& path)>& may_differ) {
  const Json then = parse_or_discard<Json>(then_text), now = Json::parse(now_text);
  check(then.is_object(), "the scene that was kept is damaged: it is no JSON object.",
        Exit::kFileError);
  std::vector<std::string> lines;
  for (const Json& change : Json::diff(then, now)) {
    const std::string path = change["path"];
    if (may_differ(path)) continue;
    Json::json_pointer at(path);
    if (path.ends_with("/-")) {  // one of these for every entry appended to a list
      at.pop_back();
      const std::string line = fmt::format("{}: {} entries -> {} entries", at.to_string(),
                                           then[at].size(), now[at].size());
      if (lines.empty() || lines.back() != line) lines.push_back(line);
      continue;
    }
    if (!then.contains(at) && is_default(path, now.at(at))) continue;
    lines.push_back(fmt::format("{}: {} -> {}", path,
                                then.contains(at) ? then[at].dump() : "absent",
                                now.contains(at) ? now[at].dump() : "absent"));
  }
  return lines;
}

}  // namespace acinus::runs
