#include "service/serve/submission.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/beast/core/detail/base64.hpp>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/spelling.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"
#include "runs/assemble/memory_need.hpp"
#include "runs/assemble/place_cells.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/scene/document.hpp"
#include "runs/scene/entries.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"

namespace acinus::service {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMostFiles = 100, kMostChanges = 200, kMostChangeBytes = 64'000;

/// Last components of the keys whose values are paths: "file", "from".
const std::set<std::string>& path_keys() {
  static const std::set<std::string> names = [] {
    std::set<std::string> all{"extends"};
    for (const runs::Entry& entry : runs::all_entries())
      if (entry.type == "path") all.insert(entry.path.substr(entry.path.rfind('.') + 1));
    return all;
  }();
  return names;
}

bool stays_inside(const std::string& path) {
  const fs::path p = path;
  return !p.is_absolute() && path.find('\0') == std::string::npos &&
         std::ranges::none_of(p, [](const fs::path& part) { return part == ".."; });
}

/// True for a number with an optional unit, which names no file: "2 h", "1e-5 J/m^2".
bool is_number_with_unit(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str() && (*end == '\0' || *end == ' ') &&
         text.find("..") == std::string::npos;
}

/// Checks all paths of a scene before any is read: only files sent along or files of shipped
/// scenes.
void check_paths(const runs::Node& node, const std::string& pointer) {
  for (const runs::JsonMember& member : node.members) {
    const std::string below = pointer + "/" + runs::pointer_part(member.name);
    const runs::Node& value = member.value;
    if (path_keys().contains(member.name) && value.kind == runs::Node::Kind::kText)
      check(stays_inside(value.text),
            fmt::format("{} = {}: a submitted scene names files it sends along in \"files\", or "
                        "those of shipped scenes, by name; nothing absolute, no \"..\"",
                        below, runs::shown(value)));
    check_paths(value, below);
  }
  for (std::size_t k = 0; k < node.items.size(); ++k)
    check_paths(node.items[k], fmt::format("{}/{}", pointer, k));
}

std::string text_of(const Json& j, const char* key) {
  if (!j.contains(key)) return "";
  check(j[key].is_string(), fmt::format("\"{}\": must be a text", key));
  return j[key];
}

/// Changes of a request, {"time.end": "2 h"}, as PATH=VALUE.
std::vector<std::string> read_set(const Json& j) {
  std::vector<std::string> set;
  if (!j.contains("set")) return set;
  check(j["set"].is_object(), "\"set\": must be an object, e.g. {\"time.end\": \"2 h\"}");
  check(j["set"].size() <= kMostChanges,
        fmt::format("\"set\": has {} changes; at most {} are taken. Send a scene that has them.",
                    j["set"].size(), kMostChanges));
  std::size_t bytes = 0;
  for (const auto& [key, value] : j["set"].items()) {
    set.push_back(key + "=" + value.dump());
    bytes += set.back().size();
  }
  check(bytes <= kMostChangeBytes, "\"set\": is too long. Send a scene that has these changes.");
  return set;
}

void write_files(const Json& j, const std::string& folder) {
  namespace base64 = boost::beast::detail::base64;
  if (!j.contains("files")) return;
  check(j["files"].is_object(), "\"files\": must be an object, {NAME: content in base64}");
  check(j["files"].size() <= kMostFiles,
        fmt::format("\"files\": {} files; at most {} are taken.", j["files"].size(), kMostFiles));
  for (const auto& [name, content] : j["files"].items()) {
    const bool plain = !name.empty() && name.size() <= 100 && name.front() != '.' &&
                       std::ranges::all_of(name, [](unsigned char c) {
                         return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
                       });
    check(plain, fmt::format("\"files\": \"{}\" is no name of a file: letters, digits, . _ -",
                             runs::pointer_part(name)));
    check(!fs::exists(fs::path(folder) / name),
          fmt::format("\"files\": {} is a file of the shipped scene; choose another name", name));
    check(content.is_string(), fmt::format("\"files\": {}: its content in base64 is a text", name));
    const std::string text = content;
    std::string bytes(base64::decoded_size(text.size()) + 3, '\0');
    const auto [n, read] = base64::decode(bytes.data(), text.data(), text.size());
    check(text.size() % 4 == 0 && read == text.find_last_not_of('=') + 1,
          fmt::format("\"files\": {}: is not in base64", name));
    bytes.resize(n);
    io::write_text_file((fs::path(folder) / name).string(), bytes);
  }
}

/// Refuses a name that is not that of a shipped scene, and so any path.
void check_shipped(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const runs::ShippedScene& scene : runs::shipped_scenes()) names.push_back(scene.name);
  check(std::ranges::count(names, name) > 0,
        fmt::format("{}: no shipped scene of that name. {}", where,
                    did_you_mean_and(nearest_name(name, names), "GET /scenes lists them")));
}

/// Name of the shipped scene that a submitted scene extends; "" = none.
std::string extended(const runs::Node& root) {
  const runs::Node* node = root.find("extends");
  if (node == nullptr || node->text.empty()) return "";
  const std::string name = fs::path(node->text).stem().string();
  check_shipped(name, "/extends = " + runs::shown(*node));
  return name;
}

runs::Document read_submitted(const Json& j, const std::string& input, RunJob& job) {
  check(j.contains("scene"), "\"scene\": missing: the name of a shipped scene, or a scene");
  if (j["scene"].is_string()) {
    job.scene = j["scene"];
    check_shipped(job.scene, "\"scene\": " + j["scene"].dump());
    runs::copy_scene(job.scene, input);
    write_files(j, input);
    return runs::read_document(input + "/" + job.scene + ".json");
  }
  check(j["scene"].is_object(), "\"scene\": must be a name or an object");
  std::string text = j["scene"].dump(2);
  runs::Node root = runs::parse_json({{"scene", input, false}}, 0, text);
  check_paths(root, "");
  if (const std::string base = extended(root); !base.empty()) {
    runs::copy_scene(base, input);
    Json scene = j["scene"];
    scene["extends"] = base + ".json";
    text = scene.dump(2);
  }
  write_files(j, input);
  return runs::parse_document(text, "scene", input);
}

void check_limits(const runs::Scene& scene, const ServeOptions& options) {
  const double cells = runs::count_wanted_cells(scene);
  check(cells <= options.max_cells,
        fmt::format("{:.3g} cells are more than this service allows for one run, {}. Take fewer "
                    "(cells, lobule.cells), or ask for a larger --max-cells.",
                    cells, options.max_cells));
  runs::check_memory(scene, options.max_memory);
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)));
}

void write_scene(const runs::Scene& scene, const std::string& folder, RunJob& job) {
  job.created = utc_now();
  job.end_s = scene.time.end;
  io::write_text_file(folder + "/scene.json", runs::write_resolved(scene));
}

}  // namespace

std::string result_key(const runs::Scene& scene) {
  return fmt::format("{}-{}-{}", scene.hash, ACINUS_VERSION, ACINUS_GIT);
}

void check_names_no_file(const std::string& assignment) {
  // Some names are those of times, too: "from": "2 h".
  const auto look_at = [&](const std::string& name, const Json& value) {
    check(!path_keys().contains(name) || !value.is_string() ||
              is_number_with_unit(value.get<std::string>()),
          fmt::format("{}: a model reads no files but those of its study",
                      runs::pointer_part(assignment)));
  };
  const std::size_t equal = std::min(assignment.find('='), assignment.size());
  const std::string path = assignment.substr(0, equal);
  const auto whole =
      runs::parse_or_discard<Json>(assignment.substr(std::min(equal + 1, assignment.size())));
  look_at(path.substr(path.find_last_of("./") + 1), whole);
  const std::function<void(const Json&)> look = [&](const Json& value) {
    if (value.is_object())
      for (const auto& [name, member] : value.items()) look_at(name, member);
    if (value.is_structured())
      for (const Json& item : value) look(item);
  };
  look(whole);
}

void prepare_submission(const std::string& folder, const ServeOptions& options) {
  const auto j =
      runs::parse_bounded<Json>(io::read_text_inside(folder, kRequestFile), "the request");
  check(j.is_object(), "the request must be a JSON object, e.g. {\"scene\": \"two_cells\"}");
  for (const auto& [key, value] : j.items())
    check(key == "scene" || key == "set" || key == "name" || key == "files",
          fmt::format("\"{}\": unknown; allowed are scene, set, name and files",
                      runs::pointer_part(key)));
  RunJob job;
  job.set = read_set(j);
  job.id = fs::path(folder).filename().string();
  const std::string input = folder + "/input";
  fs::create_directory(input);
  runs::Document document = read_submitted(j, input, job);
  for (const std::string& assignment : job.set) runs::apply_set(document, assignment);
  // Names in them are those of files sent along, not of files where the service was started.
  for (runs::Source& source : document.sources)
    if (source.is_flag) source.folder = input;
  check_paths(document.root, "");
  const runs::Scene scene = runs::read_scene(document, job.scene.empty() ? "scene" : job.scene);
  check_limits(scene, options);
  job.name = text_of(j, "name").substr(0, 200);
  if (job.name.empty()) job.name = scene.name;
  job.key = result_key(scene);
  write_scene(scene, folder, job);
  write_job(folder, job);
}

std::string evaluation_text(const std::string& name, const std::string& resolved,
                            const std::vector<std::string>& set) {
  return Json{{"name", name}, {"scene", resolved}, {"set", set}}.dump();
}

void prepare_evaluation(const std::string& folder, const ServeOptions& options) {
  const auto j =
      runs::parse_bounded<Json>(io::read_text_inside(folder, kEvaluationFile), "the request");
  const std::string name = j.at("name");
  runs::Document document = runs::parse_document(j.at("scene"), name, runs::scene_folder());
  for (const Json& assignment : j.at("set")) runs::apply_set(document, assignment);
  const runs::Scene scene = runs::read_scene(document, name);
  check_limits(scene, options);
  RunJob job;
  job.id = fs::path(folder).filename().string();
  job.name = scene.name;
  job.key = result_key(scene);
  job.evaluation = true;
  write_scene(scene, folder, job);
  write_job(folder, job);
}

}  // namespace acinus::service
