#include "runs/study/library.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.hpp"
#include "core/nearest.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;

std::vector<ShippedScene> shipped_studies() {
  const fs::path folder = fs::path(scene_folder()).parent_path() / "studies";
  std::error_code code;
  if (!fs::is_directory(folder, code)) return {};
  return list_documents(folder.string());
}

std::string find_study(const std::string& name) {
  std::error_code code;
  if (fs::exists(name, code)) return name;
  std::vector<std::string> names;
  for (const ShippedScene& study : shipped_studies()) {
    if (study.name == name) return study.file;
    names.push_back(study.name);
  }
  const std::string hint = nearest_name(name, names);
  throw Error(fmt::format("{}: no such file, and no shipped study of that name. {}`acinus list` "
                          "names them",
                          name, hint.empty() ? "" : fmt::format("Did you mean \"{}\"? ", hint)),
              Exit::kFileError);
}

}  // namespace acinus::runs
