#include "runs/openvt/run_reference.hpp"

#include <filesystem>

#include "io/checkpoint.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_scene.hpp"

namespace acinus::runs {

int run_reference(const std::string& scene, const OpenVtOptions& options,
                  std::vector<std::string> set, const std::string& folder) {
  set.insert(set.begin(), "model=" + name_of_choice(options.model));
  RunOptions run;
  run.scene_file = scene;
  run.set = set;
  run.out = folder;
  run.threads = options.threads;
  run.quiet = options.quiet;
  run.overwrite = options.overwrite;
  run.until_cells = scene == "openvt_monolayer" ? options.cells : std::nullopt;
  run.is_part = true;
  run.command_line = options.command_line;
  if (options.resume && std::filesystem::exists(folder + "/summary.json") &&
      read_summary(folder).status == RunOutcome::kCompleted)
    return 0;
  run.resume = options.resume && io::has_checkpoint(folder);
  const Scene read = read_scene(find_scene_file(scene), run.set);
  check_folder(folder, run);
  return run_scene(read, run);
}

}  // namespace acinus::runs
