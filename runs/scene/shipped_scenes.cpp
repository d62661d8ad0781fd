#include "runs/scene/shipped_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "runs/scene/document.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;

/// Adds the file names at and below a value, by the keys that the registry says are files.
void add_files(const Node& node, const std::string& pointer, std::vector<std::string>& files) {
  if (node.kind == Node::Kind::kText && !node.text.empty()) {
    const Entry* key = find_entry(pointer);
    if (key != nullptr && key->is_file && std::ranges::count(key->choices, node.text) == 0)
      files.push_back(node.text);
  }
  for (const JsonMember& member : node.members)
    add_files(member.value, pointer + "/" + pointer_part(member.name), files);
  for (std::size_t k = 0; k < node.items.size(); ++k)
    add_files(node.items[k], fmt::format("{}/{}", pointer, k), files);
}

/// File names that a scene text mentions, as written: the scene it extends (first, "" = none), then
/// networks, meshes, laws.
std::vector<std::string> mentioned_files(const std::string& path) {
  const std::vector<Source> sources{{path, fs::path(path).parent_path().string(), false}};
  const Node root = parse_json(sources, 0, read_file(path, kMaxBytes));
  const Node* extends = root.find("extends");
  std::vector<std::string> files{extends != nullptr ? extends->text : ""};
  add_files(root, "", files);
  return files;
}

/// Every file the scene needs, as paths relative to its folder.
void collect(const fs::path& folder, const fs::path& scene, std::vector<fs::path>& needed) {
  if (std::find(needed.begin(), needed.end(), scene) != needed.end()) return;
  needed.push_back(scene);
  bool is_scene = true;
  for (const std::string& file : mentioned_files((folder / scene).string())) {
    if (!file.empty()) {
      const fs::path path = (scene.parent_path() / file).lexically_normal();
      check(path.is_relative() && *path.begin() != "..",
            fmt::format("{} needs {}, which lies outside its folder; run it where it is",
                        (folder / scene).string(), file));
      if (is_scene) {
        collect(folder, path, needed);
      } else if (std::find(needed.begin(), needed.end(), path) == needed.end()) {
        needed.push_back(path);
      }
    }
    is_scene = false;
  }
}

}  // namespace

std::vector<std::string> shipped_files(const std::string& kind) {
  std::vector<std::string> files;
  std::error_code code;
  const fs::path folder = fs::path(scene_folder()).parent_path() / kind;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> shipped_names(const std::string& kind) {
  std::vector<std::string> names;
  for (const std::string& file : shipped_files(kind))
    names.push_back(fs::path(file).stem().string());
  return names;
}

std::string find_shipped_file(const std::string& kind, const std::string& name) {
  for (const std::string& file : shipped_files(kind))
    if (fs::path(file).stem() == name) return file;
  return "";
}

std::vector<ShippedScene> shipped_scenes() { return list_documents(scene_folder()); }

std::string find_document(const std::string& name, const std::string& kind,
                          std::vector<ShippedScene> (*shipped)()) {
  std::error_code code;
  const fs::file_status given = fs::status(name, code);
  if (fs::exists(given) && !fs::is_directory(given)) return name;
  std::vector<std::string> names;
  for (const ShippedScene& document : shipped()) {
    if (document.name == name) return document.file;
    names.push_back(document.name);
  }
  if (fs::exists(given)) return name;  // a folder: reading it says so
  throw Error(fmt::format("{}: no such file, and no shipped {} of that name. {}", name, kind,
                          did_you_mean_and(nearest_name(name, names), "`acinus list` names them")),
              Exit::kFileError);
}

std::vector<ShippedScene> list_documents(const std::string& folder) {
  std::vector<ShippedScene> scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    ShippedScene scene{entry.path().stem().string(), entry.path().string(), ""};
    try {
      const Document document = read_document(scene.file);
      const Node* description = document.root.find("description");
      if (description != nullptr) scene.description = description->text;
    } catch (const Error& error) {
      scene.description = std::string("cannot be read: ") + error.what();
    }
    scenes.push_back(std::move(scene));
  }
  std::sort(scenes.begin(), scenes.end(),
            [](const ShippedScene& a, const ShippedScene& b) { return a.name < b.name; });
  return scenes;
}

std::vector<std::string> copy_scene(const std::string& name, const std::string& folder) {
  const std::string stem = fs::path(name).filename().stem().string();
  std::vector<std::string> names;
  std::optional<ShippedScene> scene;
  for (const ShippedScene& shipped : shipped_scenes()) {
    names.push_back(shipped.name);
    if (shipped.name == stem) scene = shipped;
  }
  check(scene.has_value(),
        fmt::format("no shipped scene \"{}\". {}", name,
                    did_you_mean_and(nearest_name(stem, names), "`acinus list` names them")));
  const fs::path from = fs::path(scene->file).parent_path();
  std::vector<fs::path> needed;
  collect(from, fs::path(scene->file).filename(), needed);
  for (const fs::path& file : needed) {
    check(!fs::exists(fs::path(folder) / file),
          fmt::format("{} exists already; choose another folder",
                      (fs::path(folder) / file).string()));
  }
  std::vector<std::string> written;
  const bool is_new = !fs::exists(folder);
  for (const fs::path& file : needed) {
    written.push_back((fs::path(folder) / file).string());
    const fs::path target = written.back();
    std::error_code code;
    if (target.has_parent_path()) fs::create_directories(target.parent_path(), code);
    if (!code) fs::copy_file(from / file, target, code);
    if (!code) continue;
    std::error_code ignored;  // nothing half made stays behind
    for (const std::string& made : written) fs::remove(made, ignored);
    if (is_new) fs::remove_all(folder, ignored);
    throw Error(fmt::format("{}: cannot be written: {}", target.string(), code.message()),
                Exit::kFileError);
  }
  return written;
}

}  // namespace acinus::runs
