#pragma once
/// Interface of the commands: each file of this folder adds one to the command line.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/units/units.hpp"

namespace acinus::cli {

/// Subcommand with its action.
struct Command {
  CLI::App* app;             ///< subcommand, which knows if it was given
  std::function<int()> run;  ///< runs the command after parsing; returns the exit code
};

/// Adds a subcommand with its help text and an example.
inline CLI::App* add_command(CLI::App& app, const char* name, const char* meaning,
                             const char* example) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->footer(std::string("Example: ") + example);
  return command;
}

/// Adds the flag --set for changes of the scene, PATH=VALUE.
inline CLI::Option* add_set(CLI::App& command, std::vector<std::string>& set) {
  return command
      .add_option("--set", set,
                  "replace a value of the scene, e.g. --set time.end=\"2 h\"; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

/// Adds the flag --threads; 0 = all cores.
inline CLI::Option* add_threads(CLI::App& command, int& threads) {
  return command.add_option("--threads", threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

/// Positive value of a flag.
/// @param parse  conversion of a text to a value
/// @throws Error naming the flag
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

/// Positive quantity of a flag in base units.
/// @throws Error naming the flag
inline double quantity_of(const char* flag, const std::string& text, const Dimension& dimension) {
  return flag_value(flag, text, [&](const std::string& t) { return parse_quantity(t, dimension); });
}

/// Command line without one of its words.
inline std::string without_flag(const std::string& command_line, const std::string& flag) {
  const std::string words = command_line + " ", found = " " + flag + " ";
  const std::size_t at = words.find(found);
  return at == std::string::npos
             ? command_line
             : command_line.substr(0, at) +
                   command_line.substr(std::min(command_line.size(), at + flag.size() + 1));
}

/// Prints how to continue a stopped job that the same command resumes.
/// @return `code`, the exit code of the job
inline int print_how_to_continue(int code, const std::string& command_line, bool quiet) {
  if (code == static_cast<int>(Exit::kStopped) && !quiet)
    fmt::print("stopped; continue with: {}\n", command_line);
  return code;
}

/// Adds a command to the command line.
/// @param command_line  as typed, quoted for a shell, recorded as provenance; must outlive the app
Command add_bench(CLI::App& app);
Command add_calibrate(CLI::App& app, const std::string& command_line);
Command add_check(CLI::App& app);
Command add_compare(CLI::App& app, const std::string& command_line);
Command add_explain(CLI::App& app);
Command add_import(CLI::App& app);
Command add_list(CLI::App& app);
Command add_mesh(CLI::App& app);
Command add_new(CLI::App& app);
Command add_openvt(CLI::App& app, const std::string& command_line);
Command add_permedcoe(CLI::App& app, const std::string& command_line);
Command add_report(CLI::App& app);
Command add_run(CLI::App& app, const std::string& command_line);
Command add_serve(CLI::App& app);
Command add_schema(CLI::App& app);
Command add_study(CLI::App& app);
Command add_infer(CLI::App& app);
Command add_voxelise(CLI::App& app);

}  // namespace acinus::cli
