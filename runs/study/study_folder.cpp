#include "runs/study/study_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/io/disk.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;
constexpr const char* kFile = "/study.json";
}  // namespace

void check_study_folder(const std::string& root, const StudyPlan& plan) {
  std::error_code code;
  if (!fs::exists(root, code)) return;
  check(fs::is_directory(root, code),
        fmt::format("--out {}: is a file; a folder is needed.", root));
  if (fs::is_empty(root, code)) return;
  check(fs::is_regular_file(root + kFile, code),
        fmt::format("--out {}: holds something that is no study. Choose another --out.", root));
  const nlohmann::json j = nlohmann::json::parse(io::read_text_file(root + kFile), nullptr, false);
  const std::string name = j.is_object() ? j.value("study", "") : "";
  check(name == plan.study.name,
        fmt::format("--out {}: holds the study \"{}\", not \"{}\". Choose another --out.", root,
                    name, plan.study.name));
}

void make_study_folder(const std::string& root, const StudyPlan& plan) {
  std::error_code code;
  fs::create_directories(root + "/runs", code);
  check(!code,
        fmt::format("--out {}: the folder cannot be made ({}). Choose another --out.", root,
                    code.message()),
        Exit::kFileError);
  if (fs::exists(root + kFile, code)) return;
  const nlohmann::ordered_json j{{"study", plan.study.name}};
  io::write_text_file(root + kFile, j.dump(2) + "\n");
}

}  // namespace acinus::runs
