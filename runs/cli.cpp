#include "runs/cli.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/units.hpp"
#include "runs/bench/bench.hpp"
#include "runs/build_world.hpp"
#include "runs/calibrate/calibrate.hpp"
#include "runs/compare/compare.hpp"
#include "runs/run.hpp"
#include "runs/scene/explain.hpp"
#include "runs/scene/library.hpp"
#include "runs/scene/reader.hpp"
#include "runs/scene/registry.hpp"
#include "runs/scene/schema.hpp"
#include "runs/study/library.hpp"
#include "runs/study/registry.hpp"
#include "runs/study/study_command.hpp"
#include "runs/wall_time.hpp"

namespace acinus::runs {
namespace {

/// Everything the command line can set.
struct Arguments {
  RunOptions run;
  std::string until, checkpoint_every, max_walltime, progress;
  bool resolved = false, markdown = false;
  std::string key;           ///< explain
  std::string name, folder;  ///< new
  std::string bench;         ///< bench
  BenchOptions bench_options;
  CalibrateOptions calibrate;
  std::vector<std::string> folders, tolerances;  ///< compare
  std::string check_friction;                    ///< calibrate
  std::string relaxation_time;                   ///< calibrate
  std::string scene, comparison;                 ///< compare
  CompareScenes compare;
  StudyOptions study;
  bool study_schema = false;
};

void add_set(CLI::App& command, RunOptions& run) {
  command
      .add_option("--set", run.set,
                  "replace a value of the scene, e.g. --set time.end=\"2 h\"; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

void add_run_options(CLI::App& command, Arguments& arguments) {
  RunOptions& run = arguments.run;
  command.add_option("SCENE", run.scene_file, "scene file, or the name of a shipped scene")
      ->required();
  command.add_option("--out", run.out, "run folder (default: <scene name>.run in this folder)")
      ->type_name("DIR");
  add_set(command, run);
  command.add_option("--threads", run.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command.add_option("--until", arguments.until, "stop at this simulated time, e.g. \"2 h\"")
      ->type_name("TIME");
  command.add_option("--until-cells", run.until_cells, "stop when there are this many cells")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  command
      .add_option("--checkpoint-every", arguments.checkpoint_every,
                  "wall time between checkpoints (default: 10min)")
      ->type_name("WALL");
  command
      .add_option("--max-walltime", arguments.max_walltime,
                  "stop with a checkpoint after this wall time, e.g. 23h30m")
      ->type_name("WALL");
  command.add_flag("--timings", run.timings, "print the time of each stage at the end");
  command.add_flag("--quiet", run.quiet, "warnings and errors only");
  command.add_option("--progress", arguments.progress, "form of the progress lines")
      ->type_name("json")
      ->check(CLI::IsMember({"json"}));
}

CLI::App* add_command(CLI::App& app, const char* name, const char* meaning, const char* example) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->footer(std::string("Example: ") + example);
  return command;
}

void add_calibrate(CLI::App& app, Arguments& arguments) {
  CalibrateOptions& o = arguments.calibrate;
  CLI::App* command =
      add_command(app, "calibrate", "find the law that makes spheres push as deformable cells do",
                  "acinus calibrate runs/scenes/lobule_hybrid.json --out law.json");
  command->add_option("SCENE", arguments.run.scene_file,
                      "scene file or name, with the cell type (default: calibration)");
  command->add_option("--out", o.out, "law file; runs, curves and plots stand beside it")
      ->type_name("LAW.json")
      ->required();
  add_set(*command, arguments.run);
  command->add_option("--type", o.clump.type, "cell type, where the scene has several")
      ->type_name("NAME");
  command
      ->add_option("--cells", o.clump.cells, "cells of the clump, e.g. 15, 27 or 59 (default: 59)")
      ->type_name("N")
      ->check(CLI::Range(9, 1000));
  command->add_option("--rate", o.clump.rate, "factor on the speed of squeezing")
      ->type_name("F")
      ->check(CLI::Range(0.01, 10.0));
  command->add_option("--highest", o.fit.highest, "largest overlap d of the fit (default: 0.2)")
      ->type_name("D")
      ->check(CLI::Range(0.05, 0.3));
  command->add_option("--power", o.fit.power, "power of the leading term (default: 4)")
      ->type_name("P")
      ->check(CLI::Range(1.1, 12.0));
  command->add_flag("--free-power", o.fit.free_power, "fit the power as well");
  command
      ->add_option(
          "--good-enough", o.fit.good_enough,
          "relative error up to which one term is enough and no table is made (default: 0.1)")
      ->type_name("E")
      ->check(CLI::Range(0.0, 10.0));
  command->add_flag("!--no-relaxation", o.relaxation,
                    "leave out how long the clump takes to relax");
  command
      ->add_option("--check-friction", arguments.check_friction,
                   "also the relaxation with this cell-cell friction, e.g. \"1e11 N s/m^3\"")
      ->type_name("FRICTION");
  command
      ->add_option("--relaxation-time", arguments.relaxation_time,
                   "also look for the cell-cell friction with which the relaxation's exponential "
                   "fit has this time, e.g. \"5 h\" (see docs/calibration.md first)")
      ->type_name("TIME");
  command->add_flag("--fresh", o.fresh, "do not go on from what an earlier attempt left");
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  command->add_option("--threads", o.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

void add_compare(CLI::App& app, Arguments& arguments) {
  CompareScenes& o = arguments.compare;
  CLI::App* command = add_command(
      app, "compare", "how runs of the same scene differ; the first one is the reference",
      "acinus compare lobule_dcm.run lobule_cbm.run --tolerance pressure=0.2");
  command->add_option("RUN", arguments.folders, "run folders")->type_name("DIR");
  command->add_option("--out", arguments.comparison, "JSON file; plots stand beside it")
      ->type_name("FILE.json");
  std::string known;
  for (const auto& [name, meaning] : comparable_quantities())
    known += fmt::format("\n  {:14} {}", name, meaning);
  command
      ->add_option(
          "--tolerance", arguments.tolerances,
          "verdict on a quantity: NAME=VALUE, relative but for positions (um); exit code 5 "
          "if one is beyond. Names:" +
              known)
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  CLI::Option* scene =
      command
          ->add_option("--scene", arguments.scene,
                       "first run this scene with deformable cells and with spheres, into --runs")
          ->type_name("SCENE");
  command->add_option("--runs", o.folder, "folder for the runs of --scene")
      ->type_name("DIR")
      ->needs(scene);
  command->add_option("--law", o.law, "with --scene: a third run with spheres of this law")
      ->type_name("LAW.json")
      ->check(CLI::ExistingFile)
      ->needs(scene);
  command
      ->add_flag("--equal-drag", o.equal_drag,
                 "with --scene: spheres get the medium and cell friction of deformable cells")
      ->needs(scene);
  add_set(*command, arguments.run);
  command->add_option("--threads", o.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--quiet", o.quiet, "the table only");
}

void add_commands(CLI::App& app, Arguments& arguments) {
  CLI::App* run = add_command(app, "run", "simulate a scene",
                              "acinus run runs/scenes/two_cells.json --set time.end=\"30 min\"");
  add_run_options(*run, arguments);
  CLI::Option* resume = run->add_flag("--resume", arguments.run.resume,
                                      "go on from the checkpoint in the run folder");
  run->add_flag("--overwrite", arguments.run.overwrite, "replace the results in the run folder")
      ->excludes(resume);

  CLI::App* again = add_command(app, "resume", "the same as run --resume",
                                "acinus resume runs/scenes/two_cells.json");
  add_run_options(*again, arguments);

  CLI::App* validate =
      add_command(app, "check", "validate a scene and its geometry without running it",
                  "acinus check runs/scenes/two_cells.json --resolved");
  validate
      ->add_option("SCENE", arguments.run.scene_file, "scene file, or the name of a shipped scene")
      ->required();
  add_set(*validate, arguments.run);
  validate->add_flag("--resolved", arguments.resolved, "print the scene with every default");

  CLI::App* schema = add_command(app, "schema", "print the JSON Schema of scenes",
                                 "acinus schema > scene.schema.json");
  schema->add_flag("--study", arguments.study_schema, "of studies instead");

  CLI::App* explain =
      add_command(app, "explain", "say what a scene key means; without KEY, list all",
                  "acinus explain cell.radius");
  CLI::Option* key = explain->add_option("KEY", arguments.key,
                                         "path or last name of a key; study.KEY: of studies");
  explain->add_flag("--markdown", arguments.markdown, "all keys as a Markdown page")->excludes(key);

  add_command(app, "list", "list the shipped scenes, studies and the experiments", "acinus list");

  CLI::App* fresh = add_command(app, "new", "copy a shipped scene into a folder to change it",
                                "acinus new two_cells my_cells");
  fresh->add_option("SCENE", arguments.name, "name of a shipped scene")->required();
  fresh->add_option("DIR", arguments.folder, "folder, made if needed")->required();

  add_calibrate(app, arguments);
  add_compare(app, arguments);
  add_study_command(app, arguments.study);

  CLI::App* bench =
      add_command(app, "bench", "measure speed and error; without NAME, list the names",
                  "acinus bench dcm27 --json dcm27.json");
  bench->add_option("NAME", arguments.bench, "benchmark");
  bench->add_option("--json", arguments.bench_options.json_file, "also write the rows here")
      ->type_name("FILE");
  bench->add_option("--threads", arguments.bench_options.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  bench
      ->add_option("--seeds", arguments.bench_options.seeds,
                   "repetitions of random cases (default: 3)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  bench
      ->add_option("--first", arguments.bench_options.first,
                   "first seed of random cases (default: 1); --seeds 1 --first N repeats one")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  bench->add_flag("--life", arguments.bench_options.life,
                  "stress: the cells of the same scenes also grow, divide and die");
  bench->add_option("--out", arguments.bench_options.folder, "folder for plots and scenes")
      ->type_name("DIR");
}

/// Adds the flag's name to what is wrong with its value.
template <class Parse>
double flag_value(const char* flag, const std::string& text, Parse parse) {
  try {
    const double value = parse(text);
    check(value > 0, fmt::format("\"{}\": must be > 0", text));
    return value;
  } catch (const Error& error) {
    throw Error(std::string(flag) + " " + error.what(), error.code());
  }
}

int do_run(Arguments& arguments) {
  RunOptions& run = arguments.run;
  if (!arguments.until.empty()) {
    run.until_s = flag_value("--until", arguments.until,
                             [](const std::string& text) { return parse_quantity(text, kTime); });
  }
  if (!arguments.checkpoint_every.empty()) {
    run.checkpoint_every_s =
        flag_value("--checkpoint-every", arguments.checkpoint_every, parse_wall_time);
  }
  if (!arguments.max_walltime.empty()) {
    run.max_walltime_s = flag_value("--max-walltime", arguments.max_walltime, parse_wall_time);
  }
  run.progress_json = arguments.progress == "json";
  Scene scene = read_scene(find_scene_file(run.scene_file), run.set);
  if (run.out.empty()) run.out = scene.name + ".run";
  if (const int stop = resolve_corrections(scene, run.threads, run.quiet)) return stop;
  return run_scene(scene, run);
}

int do_check(const Arguments& arguments) {
  const Scene scene = read_scene(find_scene_file(arguments.run.scene_file), arguments.run.set);
  Scene plain = scene;
  std::vector<std::string> notes;
  for (auto& [name, type] : plain.cell_types) {
    if (type.cbm.stiffness_correction != "auto") continue;
    type.cbm.stiffness_correction = "none";
    notes.push_back(name + ": calibrated when the scene runs, if that was not done before");
  }
  const BuiltWorld built =
      build_world(plain, Ranks::serial());  // throws for geometry that does not fit
  notes.insert(notes.begin(), built.notes.begin(), built.notes.end());
  if (arguments.resolved) {
    fmt::print("{}", scene.resolved_json);
  } else {
    const coupling::State& state = built.world.state;
    fmt::print(
        "{}: valid scene \"{}\", {} cell type{}, {} DCM + {} CBM cells from {}, {:.0f} um of "
        "vessels, "
        "end {:.4g} h, hash {}\n",
        scene.file, scene.name, scene.cell_types.size(), scene.cell_types.size() == 1 ? "" : "s",
        dcm::count_cells(state.dcm), state.cbm.n_cell(), scene.cells.source, built.vessel_length,
        scene.time.end / 3600, scene.sha);
    for (const std::string& note : notes) fmt::print("{}\n", note);
  }
  return 0;
}

int do_explain(const Arguments& arguments) {
  if (arguments.markdown) {
    fmt::print("{}", explain_markdown());
  } else {
    const bool study = arguments.key == "study" || arguments.key.starts_with("study.");
    const std::vector<Entry>& entries = study ? study_entries() : all_entries();
    fmt::print("{}", arguments.key.empty() || arguments.key == "study"
                         ? explain_all(entries)
                         : explain_key(arguments.key, entries));
  }
  return 0;
}

int do_list() {
  fmt::print("scenes in {}\n", scene_folder());
  for (const ShippedScene& scene : shipped_scenes()) {
    fmt::print("  {:20}  {}\n", scene.name, scene.description);
  }
  if (const std::vector<ShippedScene> studies = shipped_studies(); !studies.empty()) {
    fmt::print("studies (acinus study NAME)\n");
    for (const ShippedScene& study : studies)
      fmt::print("  {:20}  {}\n", study.name, study.description);
  }
  for (const Entry& entry : all_entries()) {
    if (entry.path == "experiment")
      fmt::print("experiments (scene key experiment)\n  {}\n", entry.range);
  }
  return 0;
}

int do_new(const Arguments& arguments) {
  const std::vector<std::string> written = copy_scene(arguments.name, arguments.folder);
  for (const std::string& file : written) fmt::print("wrote {}\n", file);
  fmt::print("run it with: acinus run {}\n", written.front());
  return 0;
}

int do_calibrate(Arguments& arguments) {
  CalibrateOptions& options = arguments.calibrate;
  if (arguments.run.scene_file.empty())
    arguments.run.scene_file = scene_folder() + "/calibration.json";
  options.command_line = arguments.run.command_line;
  if (!arguments.check_friction.empty())
    options.check_friction =
        flag_value("--check-friction", arguments.check_friction,
                   [](const std::string& text) { return parse_quantity(text, kFrictionPerArea); });
  if (!arguments.relaxation_time.empty())
    options.relaxation_time =
        flag_value("--relaxation-time", arguments.relaxation_time,
                   [](const std::string& text) { return parse_quantity(text, kTime); });
  check(options.relaxation_time >= 0,
        fmt::format("--relaxation-time \"{}\": must be > 0 s", arguments.relaxation_time));
  return calibrate(read_scene(find_scene_file(arguments.run.scene_file), arguments.run.set),
                   options);
}

/// "pressure=0.2" and so on.
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

int do_compare(Arguments& arguments) {
  std::vector<std::string> folders = arguments.folders;
  const std::map<std::string, double> tolerance = read_tolerances(arguments.tolerances);
  if (!arguments.scene.empty()) {
    check(folders.empty(), "compare takes run folders or --scene, not both");
    CompareScenes& options = arguments.compare;
    const Scene scene = read_scene(find_scene_file(arguments.scene), arguments.run.set);
    if (options.folder.empty()) options.folder = scene.name + ".compare";
    options.command_line = arguments.run.command_line;
    if (const int stop = run_models(scene, options, folders)) return stop;
    if (arguments.comparison.empty()) arguments.comparison = options.folder + "/compare.json";
  }
  const Comparison comparison = compare_runs(folders, tolerance);
  fmt::print("{}", comparison_table(comparison));
  if (!arguments.comparison.empty()) write_comparison(comparison, arguments.comparison);
  return static_cast<int>(comparison.passes() ? Exit::kDone : Exit::kBeyond);
}

int do_bench(const Arguments& arguments) {
  const std::vector<std::string> names = list_benches();
  if (arguments.bench.empty()) {
    if (names.empty()) fmt::print("no benchmarks in this build\n");
    for (const std::string& name : names) fmt::print("{}\n", name);
    return 0;
  }
  if (std::find(names.begin(), names.end(), arguments.bench) == names.end()) {
    const std::string hint = nearest_name(arguments.bench, names);
    throw Error(fmt::format("no benchmark \"{}\". {}Known: {}", arguments.bench,
                            hint.empty() ? "" : fmt::format("Did you mean \"{}\"? ", hint),
                            fmt::join(names, ", ")));
  }
  return run_bench(arguments.bench, arguments.bench_options);
}

}  // namespace

std::string version_text() {
  return fmt::format("acinus {} (git {}, {}, {})", ACINUS_VERSION, ACINUS_GIT, ACINUS_COMPILER,
                     ACINUS_FLAGS);
}

int run_cli(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app("Simulator of living tissue: deformable triangulated cells (DCM) and spheres (CBM).",
               "acinus");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(
      "Help on a command: acinus run --help\n"
      "Exit codes: 0 done, 1 internal error, 2 bad scene or command line, 3 cannot continue,\n"
      "4 disk or file error, 5 compared runs beyond a tolerance, 75 stopped with a checkpoint "
      "written");
  add_commands(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? static_cast<int>(Exit::kDone) : static_cast<int>(Exit::kBadInput);
  }
  for (int i = 0; i < argc; ++i) {
    arguments.run.command_line += (i > 0 ? " " : "") + std::string(argv[i]);
  }
  const std::string command = app.get_subcommands().front()->get_name();
  if (command == "resume") arguments.run.resume = true;
  if (command == "run" || command == "resume") return do_run(arguments);
  if (command == "check") return do_check(arguments);
  if (command == "explain") return do_explain(arguments);
  if (command == "list") return do_list();
  if (command == "new") return do_new(arguments);
  if (command == "bench") return do_bench(arguments);
  if (command == "calibrate") return do_calibrate(arguments);
  if (command == "compare") return do_compare(arguments);
  if (command == "study") return run_study(arguments.study);
  fmt::print("{}", arguments.study_schema ? study_schema() : scene_schema());
  return 0;
}

}  // namespace acinus::runs
