/// Command `acinus calibrate`.

#include "runs/calibrate/calibrate_scene.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "core/units/dimension.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::cli {
namespace {

struct CalibrateArguments {
  runs::CalibrateOptions options;
  std::string scene_file = "calibration";
  std::vector<std::string> set;
  std::string check_friction, relaxation_time, max_walltime;
};

/// Refuses changes of keys that --cells sets itself: the capsule fits the clump.
void check_effects(const CalibrateArguments& a) {
  if (a.options.clump.cells == 0) return;
  for (const std::string& set : a.set)
    check(!set.starts_with("capsule.") && !set.starts_with("time.end="),
          fmt::format("--set {} has no effect beside --cells, which makes a capsule for its clump. "
                      "Write a scene with cells.count and a capsule, and calibrate that without "
                      "--cells.",
                      set));
}

int run(CalibrateArguments& arguments) {
  runs::CalibrateOptions& options = arguments.options;
  check_effects(arguments);
  const WallTimeLimit limit(read_wall_time_limit(arguments.max_walltime));
  if (!arguments.check_friction.empty())
    options.calibration.check_friction =
        quantity_of("--check-friction", arguments.check_friction, kFrictionPerArea);
  if (!arguments.relaxation_time.empty())
    options.calibration.relaxation_time =
        quantity_of("--relaxation-time", arguments.relaxation_time, kTime);
  const runs::Scene scene =
      runs::read_scene(runs::find_scene_file(arguments.scene_file), arguments.set);
  // --fresh would throw away what there is.
  return print_how_to_continue(runs::calibrate(scene, options),
                               without_flag(options.command_line, "--fresh"), options.quiet);
}

}  // namespace

Command add_calibrate(CLI::App& app, const std::string& command_line) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  runs::CalibrateOptions& o = arguments->options;
  CLI::App* command = add_command(
      app, "calibrate", "find the law that makes spheres resist compression like deformable cells",
      "acinus calibrate lobule_hybrid --out law.json");
  command->add_option("SCENE", arguments->scene_file,
                      "scene file or name, with the cell type (default: calibration)");
  command
      ->add_option("--out", o.out,
                   "law file; runs, curves and plots are written to LAW.calibration")
      ->type_name("LAW.json")
      ->required();
  add_set(*command, arguments->set);
  command->add_option("--type", o.clump.type, "cell type, where the scene has several")
      ->type_name("NAME");
  command
      ->add_option("--cells", o.clump.cells,
                   "cells of the clump, 59 or more for a law to use, fewer to try (default: 59)")
      ->type_name("N")
      ->check(CLI::Range(9, 1000));
  command->add_option("--rate", o.clump.rate, "factor on the speed of compression")
      ->type_name("F")
      ->check(CLI::Range(0.01, 10.0));
  command
      ->add_option("--highest", o.calibration.fit.highest,
                   "largest overlap d of the fit E + a1 d^p (default: 0.2)")
      ->type_name("D")
      ->check(CLI::Range(0.05, 0.3));
  command
      ->add_option("--power", o.calibration.fit.power, "power p of the fit E + a1 d^p (default: 4)")
      ->type_name("P")
      ->check(CLI::Range(1.1, 12.0));
  command->add_flag("--free-power", o.calibration.fit.free_power, "fit the power p as well");
  command
      ->add_option("--good-enough", o.calibration.fit.good_enough,
                   "relative error of the force up to which E + a1 d^p is used; above it a table "
                   "of moduli is made (default: 0.1)")
      ->type_name("E")
      ->check(CLI::Range(0.0, 10.0));
  CLI::Option* none = command->add_flag_callback(
      "--no-relaxation", [&o] { o.calibration.relaxation = false; },
      "leave out how long the clump takes to relax");
  command
      ->add_option(
          "--check-friction", arguments->check_friction,
          "also simulate the relaxation with this cell-cell friction, e.g. \"1e11 N s/m^3\"")
      ->type_name("FRICTION")
      ->excludes(none);
  command
      ->add_option("--relaxation-time", arguments->relaxation_time,
                   "also look for the cell-cell friction with which the relaxation's exponential "
                   "fit has this time, e.g. \"5 h\" (see docs/science/calibration.md first)")
      ->type_name("TIME")
      ->excludes(none)
      ->excludes("--check-friction");
  add_wall_time_limit(*command, arguments->max_walltime);
  command->add_flag("--fresh", o.fresh, "do not go on from what an earlier attempt left");
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  add_threads(*command, o.threads);
  return {command, [arguments, &command_line] {
            arguments->options.command_line = command_line;
            return run(*arguments);
          }};
}

}  // namespace acinus::cli
