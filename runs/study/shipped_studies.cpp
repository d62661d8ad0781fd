#include "runs/study/shipped_studies.hpp"

#include <filesystem>

namespace acinus::runs {
namespace fs = std::filesystem;

std::vector<ShippedScene> shipped_studies() {
  const fs::path folder = fs::path(scene_folder()).parent_path() / "studies";
  std::error_code code;
  if (!fs::is_directory(folder, code)) return {};
  return list_documents(folder.string());
}

std::string find_study(const std::string& name) {
  return find_document(name, "study", shipped_studies);
}

}  // namespace acinus::runs
