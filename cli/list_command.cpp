/// Commands `acinus list` and `acinus new`: scenes that ship with the program.

#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/physicell/convert_rules.hpp"
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

/// Prints what became of each rule.
int convert(const std::string& table, const std::string& folder,
            const std::vector<std::string>& base, const std::string& pressure) {
  const double unit_pressure = pressure.empty() ? 0 : quantity_of("--pressure", pressure, kStress);
  const runs::ConvertedRules result =
      runs::write_physicell_scene(table, folder, runs::parse_base_values(base), unit_pressure);
  for (const runs::RuleRemark& r : result.remark)
    fmt::print("{}:{}: {}{}\n", table, r.line, r.converted ? "" : "left out: ", r.text);
  fmt::print(
      "{} of {} rules converted\nwrote {}\nput in your cells and substances, then: acinus run {}\n",
      result.n_converted, result.remark.size(), result.scene, runs::quote_for_shell(result.scene));
  return 0;
}

struct NewArguments {
  std::string scene, folder, table, pressure;
  std::vector<std::string> base;
};

int make(const NewArguments& a) {
  if (!a.table.empty()) {
    check(!a.scene.empty() && a.folder.empty(),
          "--from-physicell-rules takes one folder and no scene: acinus new "
          "--from-physicell-rules rules.csv my_cells");
    return convert(a.table, a.scene, a.base, a.pressure);
  }
  check(!a.folder.empty(),
        "acinus new needs the name of a scene and a folder: acinus new two_cells "
        "my_cells");
  return copy(a.scene, a.folder);
}

}  // namespace

Command add_list(CLI::App& app) {
  return {add_command(app, "list", "list the shipped scenes, studies and laws, and the experiments",
                      "acinus list"),
          list};
}

Command add_new(CLI::App& app) {
  CLI::App* command = add_command(
      app, "new", "copy a shipped scene into a folder to change it, or make one from rules",
      "acinus new two_cells my_cells\n"
      "         acinus new --from-physicell-rules rules.csv my_cells");
  const auto arguments = std::make_shared<NewArguments>();
  NewArguments& a = *arguments;
  command->add_option("SCENE", a.scene, "name of a shipped scene");
  command->add_option("DIR", a.folder, "folder, made if needed");
  CLI::Option* table = command
                           ->add_option("--from-physicell-rules", a.table,
                                        "make a scene from a table of PhysiCell's cell rules, "
                                        "and say what became of each; then without SCENE")
                           ->type_name("FILE");
  command
      ->add_option("--base", a.base,
                   "value of a behaviour without signals, in 1/min or um/min, which tables of "
                   "version 3 have not, e.g. --base \"necrosis=0.0028\"; may be repeated")
      ->type_name("[TYPE:]BEHAVIOUR=VALUE")
      ->allow_extra_args(false)
      ->needs(table);
  command
      ->add_option(
          "--pressure", a.pressure,
          "pressure that 1 stands for in the table, where it has no unit; without it rules "
          "of pressure are left out")
      ->type_name("PRESSURE")
      ->needs(table);
  return {command, [arguments] { return make(*arguments); }};
}

}  // namespace acinus::cli
