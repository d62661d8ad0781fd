/// Commands `acinus list` and `acinus new`: scenes that ship with the program.

#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/scene/choices.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/shell_quote.hpp"
#include "runs/study/shipped_studies.hpp"

namespace acinus::cli {
namespace {

int list() {
  fmt::print("scenes in {}\n", runs::scene_folder());
  for (const runs::ShippedScene& scene : runs::shipped_scenes())
    fmt::print("  {:20}  {}\n", scene.name, scene.description);
  if (const std::vector<runs::ShippedScene> studies = runs::shipped_studies(); !studies.empty()) {
    fmt::print("studies (acinus study NAME)\n");
    for (const runs::ShippedScene& study : studies)
      fmt::print("  {:20}  {}\n", study.name, study.description);
  }
  fmt::print("stiffness laws of spheres (cell_types.NAME.cbm.stiffness_correction)\n");
  for (const std::string& file : runs::shipped_laws())
    fmt::print("  {:20}  {}\n", std::filesystem::path(file).stem().string(),
               runs::describe_law(file));
  fmt::print("experiments (scene key experiment)\n");
  const std::vector<std::string> names = runs::split_choices(runs::kChoices<runs::Experiment>);
  for (std::size_t k = 0; k < names.size(); ++k)
    fmt::print("  {:20}  {}\n", names[k],
               runs::experiment_row(static_cast<runs::Experiment>(k)).meaning);
  return 0;
}

int copy(const std::string& name, const std::string& folder) {
  const std::vector<std::string> written = runs::copy_scene(name, folder);
  for (const std::string& file : written) fmt::print("wrote {}\n", file);
  fmt::print("run it with: acinus run {}\n", runs::quote_for_shell(written.front()));
  return 0;
}

}  // namespace

Command add_list(CLI::App& app) {
  return {add_command(app, "list", "list the shipped scenes, studies and laws, and the experiments",
                      "acinus list"),
          list};
}

Command add_new(CLI::App& app) {
  CLI::App* command = add_command(app, "new", "copy a shipped scene into a folder to change it",
                                  "acinus new two_cells my_cells");
  const auto name = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  command->add_option("SCENE", *name, "name of a shipped scene")->required();
  command->add_option("DIR", *folder, "folder, made if needed")->required();
  return {command, [name, folder] { return copy(*name, *folder); }};
}

}  // namespace acinus::cli
