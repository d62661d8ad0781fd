#include "cli/cli.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "acinus_version.hpp"
#include "cli/command.hpp"
#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "core/spelling.hpp"
#include "runs/session/shell_quote.hpp"
#include "runs/session/together.hpp"

namespace acinus::cli {

std::string version_text() {
  return fmt::format("acinus {} (git {}, {}, {})", ACINUS_VERSION, ACINUS_GIT, ACINUS_COMPILER,
                     ACINUS_FLAGS);
}

namespace {

/// True if mpirun started this program as one of several processes. Other launchers are not
/// recognised: they also start independent processes, such as tasks of a study.
bool started_by_mpirun() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr && std::atoi(size) > 1;
}

/// Refuses empty words, which come from unset shell variables.
void check_words(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& word : option->results())
      check(!word.empty(),
            fmt::format("{} \"\": is empty. Give a value, or leave it out.", option->get_name()));
  for (const CLI::App* part : command.get_subcommands()) check_words(*part);
}

/// Explains a first word that is no command.
void check_first_word(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, word) != names.end()) return;
  const bool is_scene = word.ends_with(".json");
  const std::string hint =
      is_scene ? fmt::format("Did you mean: acinus run {}?", runs::quote_for_shell(word))
               : did_you_mean(nearest_name(word, names));
  throw Error(fmt::format("{}: no such command.{} acinus --help lists them.", word,
                          hint.empty() ? "" : " " + hint));
}

/// Nearest option to one that a command does not have: " Did you mean ...?", or nothing.
std::string hint_of_options(const CLI::App& app, int argc, const char* const* argv) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  if (used.empty()) return {};
  std::vector<std::string> names;
  for (const CLI::Option* option : used.front()->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::ranges::find(names, word) != names.end()) continue;
    if (const std::string near = nearest_name(word, names); !near.empty())
      return did_you_mean(near) + "\n";
  }
  return {};
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
  CLI::App app("Simulator of living tissue: deformable triangulated cells (DCM) and spheres (CBM).",
               "acinus");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(
      "Help on a command: acinus run --help. On a key of scenes: acinus explain contact.range.\n"
      "Pages: docs/index.md of the source, or share/doc/acinus/docs/index.md.\n"
      "Exit codes: 0 done, 1 internal error, 2 bad scene or command line, 3 cannot continue,\n"
      "4 disk or file error, 5 compared runs beyond a tolerance, 75 stopped with a checkpoint "
      "written");
  std::string command_line;
  for (int i = 0; i < argc; ++i)
    command_line += (i > 0 ? " " : "") + runs::quote_for_shell(argv[i]);
  const Command commands[] = {add_run(app, command_line),
                              add_check(app),
                              add_schema(app),
                              add_explain(app),
                              add_list(app),
                              add_new(app),
                              add_mesh(app),
                              add_import(app),
                              add_voxelise(app),
                              add_calibrate(app, command_line),
                              add_compare(app, command_line),
                              add_report(app),
                              add_study(app),
                              add_infer(app),
                              add_serve(app),
                              add_openvt(app, command_line),
                              add_permedcoe(app, command_line),
                              add_bench(app)};
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "help" && argc == 2) {
    fmt::print("{}", app.help());
    return static_cast<int>(Exit::kDone);
  }
  if (!first.empty() && first.front() != '-') check_first_word(app, first);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Of several processes one says what is wrong.
    std::ostringstream out, wrong;
    const int code = app.exit(error, out, wrong);
    if (!started_by_mpirun() || Ranks::world().is_root()) {
      fmt::print("{}", out.str());
      fmt::print(stderr, "{}", wrong.str());
      if (code != 0) fmt::print(stderr, "{}", hint_of_options(app, argc, argv));
    }
    return static_cast<int>(code == 0 ? Exit::kDone : Exit::kBadInput);
  }
  for (const Command& command : commands)
    if (command.app->parsed()) {
      const auto refuse = [&] {
        throw Error(fmt::format(
            "acinus {} is one process: start it without mpirun. Of the commands only acinus run "
            "shares its work among processes.",
            command.app->get_name()));
      };
      check_words(*command.app);
      // Benchmarks are another program, which says itself what it is for.
      const std::string name = command.app->get_name();
      if (name != "run" && name != "bench" && started_by_mpirun())
        runs::together(Ranks::world(), refuse);
      return command.run();
    }
  return static_cast<int>(Exit::kBadInput);
}

}  // namespace acinus::cli
