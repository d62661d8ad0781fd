#include "runs/session/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/field_file.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

constexpr std::array kResultFiles{
    "run.vtkhdf",         "run.vtkhdf.sums",         "run.vtkhdf.journal",
    "run.vtkhdf.damaged", "run.vtkhdf.damaged.sums", "run.xmf",
    "summary.json",       "checkpoint.h5",           "checkpoint.prev.h5",
    "start.h5",           "fields.vtkhdf.series",    "run.log"};

/// Lock file held while a run writes in the folder. It is never removed: two processes could
/// otherwise hold two files of that name.
constexpr const char* kLockedFile = "run.lock";

std::string lock_file(const std::string& folder) { return folder + "/" + kLockedFile; }

/// True if a resumed run may change the key.
bool may_change(const std::string& pointer) {
  const Entry* key = find_innermost_entry(pointer);
  return key != nullptr && key->affects >= Affects::kOutput;
}

/// Checks that the folder holds the checkpoint the run needs, and no results it may not replace.
void check_use(const std::string& folder, const RunOptions& options) {
  std::error_code failed;
  check(!fs::exists(folder, failed) || fs::is_directory(folder),
        fmt::format("--out {}: is a file; a folder is needed.", folder));
  const bool results = std::ranges::any_of(
      kResultFiles, [&](const char* f) { return fs::exists(fs::path(folder) / f); });
  if (options.resume) {
    check(io::has_checkpoint(folder),
          fmt::format("--resume: {} holds no checkpoint{}.", folder,
                      results ? "; the run ended before the first was written. Run with "
                                "--overwrite in place of --resume to start anew"
                              : ". Run without --resume to start anew"));
    return;
  }
  check(!results || options.overwrite,
        fmt::format(
            "--out {}: holds the results of an earlier run, which are never replaced unasked. "
            "Choose another --out, continue it with --resume, or replace it with --overwrite.",
            folder));
}

Error being_written(const std::string& folder) {
  constexpr double kLockTimeout = 2;  // s
  return Error(fmt::format(
      "--out {}: {} is writing in this folder. Wait until it ends, or choose another --out.",
      folder, io::name_holder(lock_file(folder), kLockTimeout)));
}

}  // namespace

bool is_being_written(const std::string& folder) { return io::is_locked(lock_file(folder)); }

void check_folder(const std::string& folder, const RunOptions& options) {
  if (is_being_written(folder)) throw being_written(folder);
  check_use(folder, options);
}

io::FileLock prepare_folder(const std::string& folder, const RunOptions& options) {
  std::error_code failed;
  if (options.resume || !fs::is_directory(folder, failed)) check_use(folder, options);
  fs::create_directories(folder, failed);
  check(!failed,
        fmt::format("--out {}: the folder cannot be made ({}). Choose another --out.", folder,
                    failed.message()),
        Exit::kFileError);
  check(::access(folder.c_str(), W_OK) == 0,
        fmt::format("--out {}: the folder cannot be written. Choose another --out.", folder),
        Exit::kFileError);
  // Before the check of the folder: another process may be about to write into it.
  std::optional<io::FileLock> lock = io::FileLock::try_take(lock_file(folder), 1);
  if (!lock) throw being_written(folder);
  check_use(folder, options);
  if (options.overwrite) {
    for (const char* f : kResultFiles) fs::remove(fs::path(folder) / f, failed);
    fs::remove_all(fs::path(folder) / io::FieldFiles::kFolder, failed);
  }
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
