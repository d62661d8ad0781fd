#include "runs/study/study_folder.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;
constexpr const char* kFile = "/study.json";

/// True if the folder is that of a study. Waits up to 2 s, since another task may be creating it.
bool has_study_file(const std::string& root) {
  constexpr int kMostPolls = 40;
  for (int poll = 0; poll < kMostPolls; ++poll) {
    std::error_code code;
    if (fs::is_regular_file(root + kFile, code)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}
}  // namespace

void check_study_folder(const std::string& root, const StudyPlan& plan) {
  std::error_code code;
  if (!fs::exists(root, code)) return;
  check(fs::is_directory(root, code),
        fmt::format("--out {}: is a file; a folder is needed.", root));
  if (fs::is_empty(root, code)) return;
  check(has_study_file(root),
        fmt::format("--out {}: holds something that is no study. Choose another --out.", root));
  const std::string name =
      text_at(parse_or_discard<nlohmann::json>(io::read_text_file(root + kFile)), "study");
  check(name == plan.study.name,
        fmt::format("--out {}: holds the study \"{}\", not \"{}\". Choose another --out.", root,
                    name, plan.study.name));
}

void make_study_folder(const std::string& root, const StudyPlan& plan) {
  std::error_code code;
  fs::create_directories(root, code);
  // First the file that names the study: other tasks may open it already.
  if (!code && !fs::exists(root + kFile, code)) {
    const nlohmann::ordered_json j{{"study", plan.study.name}};
    try {
      io::write_text_file(root + kFile, j.dump(2) + "\n");
    } catch (const Error&) {  // another task wrote the same at the same moment
      if (!fs::exists(root + kFile, code)) throw;
    }
  }
  if (!code) fs::create_directories(root + "/runs", code);
  check(!code,
        fmt::format("--out {}: the folder cannot be made ({}). Choose another --out.", root,
                    code.message()),
        Exit::kFileError);
}

}  // namespace acinus::runs
