#include "runs/session/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "runs/scene/differences.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

constexpr std::array kResultFiles{"run.vtkhdf",         "run.xmf",  "summary.json", "checkpoint.h5",
                                  "checkpoint.prev.h5", "start.h5", "run.log"};

/// Held while a run writes in the folder. Every run has it, and it stays the same file.
constexpr const char* kLockedFile = "run.log";

/// Keys that a resumed run may change.
bool may_change(const std::string& pointer) {
  return pointer == "/name" || pointer == "/description" || pointer == "/time/end" ||
         pointer == "/start_up/from" || pointer.starts_with("/output");
}

}  // namespace

bool is_being_written(const std::string& folder) {
  return io::is_locked(folder + "/" + kLockedFile);
}

io::FileLock prepare_folder(const std::string& folder, const RunOptions& options) {
  std::error_code failed;
  const bool exists = fs::exists(folder, failed);
  check(!exists || fs::is_directory(folder),
        fmt::format("--out {}: is a file; a folder is needed.", folder));
  const bool results = std::ranges::any_of(
      kResultFiles, [&](const char* f) { return fs::exists(fs::path(folder) / f); });
  if (options.resume) {
    check(io::has_checkpoint(folder),
          fmt::format("--resume: {} holds no checkpoint. Run without --resume to start anew.",
                      folder));
  } else {
    check(!results || options.overwrite,
          fmt::format(
              "--out {}: holds the results of an earlier run, which are never replaced unasked. "
              "Choose another --out, continue it with --resume, or replace it with --overwrite.",
              folder));
  }
  fs::create_directories(folder, failed);
  check(!failed,
        fmt::format("--out {}: the folder cannot be made ({}). Choose another --out.", folder,
                    failed.message()),
        Exit::kFileError);
  check(::access(folder.c_str(), W_OK) == 0,
        fmt::format("--out {}: the folder cannot be written. Choose another --out.", folder),
        Exit::kFileError);
  std::optional<io::FileLock> lock = io::FileLock::try_take(folder + "/" + kLockedFile, 1);
  check(lock.has_value(),
        fmt::format("--out {}: another process is writing in this folder. Wait until it ends, or "
                    "choose another --out.",
                    folder),
        Exit::kFileError);
  if (results && options.overwrite && !options.resume)
    for (const char* f : kResultFiles)
      if (f != std::string_view(kLockedFile)) fs::remove(fs::path(folder) / f, failed);
  return std::move(*lock);
}

void check_same_scene(const io::CheckpointData& checkpoint, const Scene& scene) {
  std::string differences;
  for (const std::string& line :
       list_scene_differences(checkpoint.text("scene"), scene.resolved_json, may_change))
    differences += "  " + line + "\n";
  check(differences.empty(),
        fmt::format("{}: made from another scene. Keys that differ (then -> now):\n{}Only time.end "
                    "and output may change on "
                    "--resume; use the same scene, or start anew with another --out.",
                    checkpoint.source(), differences));
}

}  // namespace acinus::runs
