/// Command `acinus compare`.

#include "runs/compare/compare.hpp"

#include <fmt/ranges.h>

#include <charconv>
#include <map>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/guarded.hpp"

namespace acinus::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> folders, tolerances, set;
  std::string scene, out, until;
  runs::CompareScenes scenes;
};

/// Parses tolerances such as "pressure=0.2".
std::map<std::string, double> read_tolerances(const std::vector<std::string>& texts) {
  std::map<std::string, double> out;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    double value = 0;
    const char* end = text.data() + text.size();
    const char* first = at == std::string::npos ? end : text.data() + at + 1;
    const auto [rest, code] = std::from_chars(first, end, value);
    check(at != std::string::npos && code == std::errc() && rest == end,
          fmt::format("--tolerance \"{}\": write NAME=VALUE, e.g. pressure=0.2", text));
    out[text.substr(0, at)] = value;
  }
  return out;
}

int run(CompareArguments& arguments) {
  std::vector<std::string> folders = arguments.folders;
  const std::map<std::string, double> tolerance = read_tolerances(arguments.tolerances);
  std::optional<double> until;
  if (!arguments.until.empty()) until = quantity_of("--until", arguments.until, kTime);
  if (!arguments.scene.empty()) {
    check(folders.empty(), "compare takes run folders or --scene, not both");
    runs::CompareScenes& options = arguments.scenes;
    if (!options.law.empty()) options.law = runs::law_file(options.law);
    const runs::Scene scene =
        runs::read_scene(runs::find_scene_file(arguments.scene), arguments.set);
    if (options.folder.empty()) options.folder = scene.name + ".compare";
    if (const int stop = runs::run_models(scene, options, folders))
      return print_how_to_continue(stop, options.command_line, options.quiet);
    if (arguments.out.empty()) arguments.out = options.folder + "/compare.json";
  }
  const runs::Comparison comparison = runs::compare_runs(folders, tolerance, until);
  fmt::print("{}", runs::comparison_table(comparison));
  if (!arguments.out.empty()) runs::write_comparison(comparison, arguments.out);
  return static_cast<int>(comparison.passes() ? Exit::kDone : Exit::kBeyond);
}

}  // namespace

Command add_compare(CLI::App& app, const std::string& command_line) {
  const auto arguments = std::make_shared<CompareArguments>();
  runs::CompareScenes& o = arguments->scenes;
  CLI::App* command = add_command(
      app, "compare", "how runs of the same scene differ; the first one is the reference",
      "acinus compare lobule_dcm.run lobule_cbm.run --tolerance pressure=0.2");
  command->add_option("RUN", arguments->folders, "run folders")->type_name("DIR");
  command->add_option("--out", arguments->out, "JSON file; plots are written beside it")
      ->type_name("FILE.json");
  std::string known;
  for (const auto& [name, meaning] : runs::comparable_quantities())
    known += fmt::format("\n  {:14} {}", name, meaning);
  command
      ->add_option(
          "--tolerance", arguments->tolerances,
          "verdict on a quantity: NAME=VALUE, relative but for positions (um); exit code 5 "
          "if one is beyond. Names:" +
              known)
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  CLI::Option* scene =
      command
          ->add_option("--scene", arguments->scene,
                       "first run this scene with deformable cells and with spheres, into --runs")
          ->type_name("SCENE");
  command->add_option("--runs", o.folder, "folder for the runs of --scene")
      ->type_name("DIR")
      ->needs(scene);
  command
      ->add_option("--law", o.law,
                   "with --scene: a third run with spheres of this law, a file or the name of a "
                   "shipped one")
      ->type_name("LAW")
      ->needs(scene);
  command
      ->add_flag("--equal-drag", o.equal_drag,
                 "with --scene: spheres get the medium and cell friction of deformable cells")
      ->needs(scene);
  command
      ->add_option("--until", arguments->until,
                   "judge this simulated time, e.g. \"2 h\", in place of the end; all runs need a "
                   "frame there")
      ->type_name("TIME");
  add_set(*command, arguments->set)->needs(scene);
  add_threads(*command, o.threads)->needs(scene);
  command->add_flag("--quiet", o.quiet, "with --scene: the table only")->needs(scene);
  return {command, [arguments, &command_line] {
            arguments->scenes.command_line = command_line;
            if (!arguments->scene.empty()) return run(*arguments);
            return runs::run_guarded(fmt::format("{}", fmt::join(arguments->folders, ", ")),
                                     [&] { return run(*arguments); });
          }};
}

}  // namespace acinus::cli
