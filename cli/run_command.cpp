/// Command `acinus run`.

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/sizes.hpp"
#include "cli/wall_time.hpp"
#include "core/numbers/time_grid.hpp"
#include "core/parallel/stop.hpp"
#include "core/units/dimension.hpp"
#include "runs/calibrate/law_cache.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_scene.hpp"
#include "runs/session/together.hpp"
#include "service/report/make_report.hpp"

namespace acinus::cli {
namespace {

struct RunArguments {
  runs::RunOptions run;
  bool report = false;
  std::string until, checkpoint_every, max_walltime, max_memory, progress, sharing;
  std::optional<int> max_cells;
};

/// Refuses several processes that a launcher started without connecting them: each would run the
/// whole scene into the same folder.
void check_launcher(const Ranks& ranks) {
  if (!ranks.is_alone()) return;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* size = std::getenv(name);
    if (size == nullptr || std::atoi(size) <= 1) continue;
    throw Error(
        fmt::format("this is one of {} processes that were started together but do not find each "
                    "other ({}): acinus was built with another MPI than that of the launcher, or "
                    "srun was not told of any. Use the mpirun of Open MPI, or srun --mpi=pmix.",
                    size, name),
        Exit::kCannotContinue);
  }
}

/// Warns of options without effect for this scene or launcher.
void check_effect(const RunArguments& arguments, const runs::Scene& scene, const Ranks& ranks) {
  const runs::RunOptions& run = arguments.run;
  check(!run.until_s || *run.until_s <= scene.time.end + kSameTime,
        fmt::format("--until \"{}\": the scene ends before, at time.end = {:.6g} s. Leave the "
                    "option out, or raise the end with --set time.end=\"{}\"",
                    arguments.until, scene.time.end, arguments.until));
  check(
      !run.until_cells ||
          std::ranges::any_of(scene.cell_types,
                              [](const auto& type) { return type.second.cycle.time > 0; }),
      fmt::format("--until-cells {}: no cell type has a cycle (acinus explain cell.cycle.time), so "
                  "that there are never more cells. Leave the option out.",
                  run.until_cells.value_or(0)));
  check(
      arguments.sharing.empty() || !ranks.is_alone(),
      "--sharing: there is one process, which shares nothing. Start several with mpirun, or leave "
      "the option out.");
}

int run(RunArguments& arguments) {
  runs::RunOptions& run = arguments.run;
  if (!arguments.until.empty()) run.until_s = quantity_of("--until", arguments.until, kTime);
  if (!arguments.checkpoint_every.empty())
    run.checkpoint_every_s =
        flag_value("--checkpoint-every", arguments.checkpoint_every, parse_wall_time);
  const WallTimeLimit limit(read_wall_time_limit(arguments.max_walltime));
  if (!arguments.max_memory.empty())
    run.max_memory = flag_value("--max-memory", arguments.max_memory, parse_size);
  if (arguments.sharing == "random") run.sharing = coupling::Sharing::kRandom;
  run.progress_json = arguments.progress == "json";
  std::optional<ExitAtSignal> nothing_to_save(std::in_place);
  const Ranks ranks = Ranks::world();
  check_launcher(ranks);
  runs::Scene scene = runs::together(ranks, [&] {
    runs::Scene read = runs::read_scene(runs::find_scene_file(run.scene_file), run.set);
    check_effect(arguments, read, ranks);
    if (arguments.max_cells)  // a limit, so no fault where it has no effect
      run.until_cells =
          std::min(run.until_cells.value_or(*arguments.max_cells), *arguments.max_cells);
    if (run.out.empty()) run.out = read.name + ".run";
    if (ranks.is_root()) runs::check_folder(run.out, run);  // not after hours of calibration
    return read;
  });
  // One process calibrates, the others find what it made.
  int stop = 0;
  const auto resolve = [&] {
    stop = runs::resolve_corrections(scene, run.threads, run.quiet || run.progress_json);
  };
  if (ranks.is_root())
    runs::together(ranks, resolve);
  else
    runs::together(ranks, [] {});
  stop = ranks.agree_worst(stop);
  if (stop != 0)
    return ranks.is_root() ? print_how_to_continue(stop, run.command_line, run.quiet) : stop;
  if (!ranks.is_root()) resolve();
  const int code = runs::run_scene(scene, run);
  nothing_to_save.reset();
  if (arguments.report && ranks.is_root()) {
    const std::string page =
        service::write_report({.what = {run.out}, .out = run.out + "/report.html"});
    if (!run.quiet) fmt::print("report: {}\n", page);
  }
  return code;
}

}  // namespace

Command add_run(CLI::App& app, const std::string& command_line) {
  CLI::App* command =
      add_command(app, "run", "simulate a scene", "acinus run two_cells --set time.end=\"30 min\"");
  const auto arguments = std::make_shared<RunArguments>();
  runs::RunOptions& run = arguments->run;
  command->add_option("SCENE", run.scene_file, "scene file, or the name of a shipped scene")
      ->required();
  command->add_option("--out", run.out, "run folder (default: <scene name>.run in this folder)")
      ->type_name("DIR");
  add_set(*command, run.set);
  add_threads(*command, run.threads);
  command->add_option("--until", arguments->until, "stop at this simulated time, e.g. \"2 h\"")
      ->type_name("TIME");
  command
      ->add_option("--max-cells", arguments->max_cells,
                   "stop when there are this many cells, also where cells may not divide")
      ->check(CLI::PositiveNumber);
  command->add_option("--until-cells", run.until_cells, "stop when there are this many cells")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  command
      ->add_option("--checkpoint-every", arguments->checkpoint_every,
                   "wall time between checkpoints (default: 10min)")
      ->type_name("WALL");
  add_wall_time_limit(*command, arguments->max_walltime);
  command
      ->add_option(
          "--max-memory", arguments->max_memory,
          "stop with a checkpoint when a process uses more, e.g. 16GB (default: 95 % of the "
          "machine's, divided among the processes on it)")
      ->type_name("SIZE");
  command
      ->add_option("--sharing", arguments->sharing,
                   "how processes of mpirun share the cells; random is slow and tests that nothing "
                   "depends on it")
      ->type_name("balanced|random")
      ->check(CLI::IsMember({"balanced", "random"}));
  command->add_flag("--timings", run.timings, "print the time of each stage at the end");
  command->add_flag("--report", arguments->report,
                    "at the end write report.html into the run folder, a page for the browser");
  CLI::Option* quiet = command->add_flag("--quiet", run.quiet, "warnings and errors only");
  command
      ->add_flag("--verbose", run.verbose,
                 "also print steps, rates and work that was skipped, as run.log has it")
      ->excludes(quiet);
  command->add_option("--progress", arguments->progress, "form of the progress lines")
      ->type_name("json")
      ->check(CLI::IsMember({"json"}))
      ->excludes(quiet);
  CLI::Option* resume =
      command->add_flag("--resume", run.resume, "go on from the checkpoint in the run folder");
  command->add_flag("--overwrite", run.overwrite, "replace the results in the run folder")
      ->excludes(resume);
  return {command, [arguments, &command_line] {
            arguments->run.command_line = command_line;
            return cli::run(*arguments);
          }};
}

}  // namespace acinus::cli
