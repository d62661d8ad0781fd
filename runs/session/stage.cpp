#include "runs/session/stage.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_scene.hpp"

namespace acinus::runs {

std::optional<RunSummary> find_run(const Scene& scene, const std::string& folder) {
  std::error_code code;
  if (!std::filesystem::exists(folder + "/summary.json", code)) return std::nullopt;
  RunSummary s = read_summary(folder);
  if (s.hash != scene.hash || s.version != ACINUS_VERSION) return std::nullopt;
  return s;
}

int run_stage(const Scene& scene, const StageOptions& options) {
  RunOptions run;
  run.scene_file = scene.file;
  run.out = options.folder;
  run.threads = options.threads;
  run.quiet = options.quiet;
  run.command_line = options.command_line;
  run.checkpoint_every_s = 60;
  run.is_part = true;
  if (const std::optional<RunSummary> before = find_run(scene, options.folder);
      before && !options.fresh) {
    if (before->status == RunOutcome::kCompleted) return static_cast<int>(Exit::kDone);
    if (before->status == RunOutcome::kFailed) {
      fmt::print(stderr,
                 "{}: an earlier run of this scene could not go on: {} Remove the folder to run it "
                 "again.\n",
                 options.folder, before->cause);
      return static_cast<int>(Exit::kCannotContinue);
    }
    run.resume = before->status == RunOutcome::kStopped;
  }
  run.overwrite = !run.resume;
  return run_scene(scene, run);
}

}  // namespace acinus::runs
