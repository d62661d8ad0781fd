#include "runs/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::array kResultFiles{"run.vtkhdf",         "run.xmf", "summary.json", "checkpoint.h5",
                                  "checkpoint.prev.h5", "run.log"};

/// Keys that a resumed run may change.
bool may_change(const std::string& pointer) {
  return pointer == "/name" || pointer == "/description" || pointer == "/time/end" ||
         pointer.starts_with("/output");
}

/// Collects "pointer: then -> now" of every leaf that differs.
void compare(const Json& then, const Json& now, std::string& differences) {
  for (const Json& change : Json::diff(then, now)) {
    const std::string path = change["path"];
    if (may_change(path)) continue;
    Json::json_pointer at(path);
    if (path.ends_with("/-")) {  // one of these for every entry appended to a list
      at.pop_back();
      const std::string line = fmt::format("  {}: {} entries -> {} entries\n", at.to_string(),
                                           then[at].size(), now[at].size());
      if (!differences.ends_with(line)) differences += line;
      continue;
    }
    differences +=
        fmt::format("  {}: {} -> {}\n", path, then.contains(at) ? then[at].dump() : "absent",
                    now.contains(at) ? now[at].dump() : "absent");
  }
}

}  // namespace

void prepare_folder(const std::string& folder, const RunOptions& options) {
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
  if (results && options.overwrite && !options.resume)
    for (const char* f : kResultFiles) fs::remove(fs::path(folder) / f, failed);
}

void check_same_scene(const io::CheckpointData& checkpoint, const Scene& scene) {
  std::string differences;
  compare(Json::parse(checkpoint.text("scene")), Json::parse(scene.resolved_json), differences);
  check(differences.empty(),
        fmt::format("{}: made from another scene. Keys that differ (then -> now):\n{}Only time.end "
                    "and output may change on "
                    "--resume; use the same scene, or start anew with another --out.",
                    checkpoint.source(), differences));
}

}  // namespace acinus::runs
