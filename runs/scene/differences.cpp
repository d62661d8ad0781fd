#include "runs/scene/differences.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::runs {

std::vector<std::string> list_scene_differences(
    const std::string& then_text, const std::string& now_text,
    const std::function<bool(const std::string& path)>& may_differ) {
  using Json = nlohmann::json;
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
    lines.push_back(fmt::format("{}: {} -> {}", path,
                                then.contains(at) ? then[at].dump() : "absent",
                                now.contains(at) ? now[at].dump() : "absent"));
  }
  return lines;
}

}  // namespace acinus::runs
