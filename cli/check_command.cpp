/// Command `acinus check`.

#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "core/parallel/memory.hpp"
#include "core/parallel/stop.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/memory_need.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/accuracy.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/result_text.hpp"

namespace acinus::cli {
namespace {

struct CheckArguments {
  std::string scene_file;
  std::vector<std::string> set;
  std::string max_walltime;
  bool resolved = false;  ///< print the scene with all defaults
};

/// Suggests a stiffness law for plain spheres beside deformable cells.
void suggest_laws(const runs::Scene& scene, const coupling::State& state) {
  if (dcm::count_cells(state.dcm) == 0 || state.cbm.n_cell() == 0) return;
  for (const auto& [name, type] : scene.cell_types) {
    if (type.cbm.stiffness_correction != "none") continue;
    const std::string law = runs::find_shipped_law(scene, type);
    fmt::print(
        "{0}: plain spheres press several times as hard as deformable cells in the same tissue. "
        "--set cell_types.{0}.cbm.stiffness_correction=auto {1}\n",
        name,
        law.empty() ? "calibrates them, some minutes once"
                    : "takes the shipped law " + std::filesystem::path(law).stem().string());
  }
}

int check_scene(const CheckArguments& arguments) {
  const WallTimeLimit limit(read_wall_time_limit(arguments.max_walltime));
  const ExitAtLimit nothing_to_save;
  const runs::Scene scene =
      runs::read_scene(runs::find_scene_file(arguments.scene_file), arguments.set);
  runs::Scene plain = scene;
  runs::use_shipped_laws(plain);
  const std::vector<std::string> later = runs::leave_out_calibrations(plain);
  runs::check_memory(plain, machine_memory());
  const runs::BuiltWorld built =
      runs::build_world(plain, Ranks::serial());  // throws for geometry that does not fit
  for (const std::string& warning : built.notes.warnings)
    fmt::print(stderr, "acinus: warning: {}\n", warning);
  if (arguments.resolved) {
    fmt::print("{}", scene.resolved_json);
    if (scene.accuracy != runs::Accuracy::kByKey)
      fmt::print(stderr, "{}\n", runs::describe_accuracy(scene));
    return 0;
  }
  const coupling::State& state = built.world.state;
  fmt::print(
      "{}: valid scene \"{}\", {} cell type{}, {} from {}{}, end {:.4g} h, hash {}\n", scene.file,
      scene.name, scene.cell_types.size(), scene.cell_types.size() == 1 ? "" : "s",
      runs::describe_cells(dcm::count_cells(state.dcm), static_cast<int>(state.cbm.n_cell())),
      runs::name_of_choice(scene.cells.source),
      built.vessel_length > 0 ? fmt::format(", {:.0f} um of vessels", built.vessel_length) : "",
      scene.time.end / 3600, scene.hash);
  if (scene.accuracy != runs::Accuracy::kByKey) fmt::print("{}\n", runs::describe_accuracy(scene));
  for (const std::string& note : built.notes.info) fmt::print("{}\n", note);
  for (const std::string& name : later)
    fmt::print("{}: calibrated when the scene runs, if that was not done before\n", name);
  suggest_laws(scene, built.world.state);
  return 0;
}

}  // namespace

Command add_check(CLI::App& app) {
  CLI::App* command =
      add_command(app, "check", "validate a scene and its geometry without running it",
                  "acinus check two_cells --resolved");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("SCENE", arguments->scene_file, "scene file, or the name of a shipped scene")
      ->required();
  add_set(*command, arguments->set);
  add_wall_time_limit(*command, arguments->max_walltime, "end after this wall time with exit 75");
  command->add_flag("--resolved", arguments->resolved, "print the scene with every default");
  return {command, [arguments] { return check_scene(*arguments); }};
}

}  // namespace acinus::cli
