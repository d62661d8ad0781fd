#pragma once
/// What the files of this folder share: each adds one command to the command line.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/units/units.hpp"

namespace acinus::runs {

struct Command {
  CLI::App* app;             ///< knows whether it was asked for
  std::function<int()> run;  ///< does it, once the command line is parsed; returns the exit code
};

inline CLI::App* add_command(CLI::App& app, const char* name, const char* meaning,
                             const char* example) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->footer(std::string("Example: ") + example);
  return command;
}

inline CLI::Option* add_set(CLI::App& command, std::vector<std::string>& set) {
  return command
      .add_option("--set", set,
                  "replace a value of the scene, e.g. --set time.end=\"2 h\"; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

inline CLI::Option* add_threads(CLI::App& command, int& threads) {
  return command.add_option("--threads", threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

/// The positive value of a flag.   @param parse  text to value
/// @throws Error that names the flag
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

inline double quantity_of(const char* flag, const std::string& text, const Dimension& dimension) {
  return flag_value(flag, text, [&](const std::string& t) { return parse_quantity(t, dimension); });
}

/// A command line without one of its words.
inline std::string without_flag(const std::string& command_line, const std::string& flag) {
  const std::string words = command_line + " ", found = " " + flag + " ";
  const std::size_t at = words.find(found);
  return at == std::string::npos
             ? command_line
             : command_line.substr(0, at) +
                   command_line.substr(std::min(command_line.size(), at + flag.size() + 1));
}

/// Says how to go on with a job that was stopped and is taken up where it was by the same command.
/// @return the exit code of that job
inline int tell_how_to_go_on(int code, const std::string& command_line, bool quiet) {
  if (code == static_cast<int>(Exit::kStopped) && !quiet)
    fmt::print("stopped; continue with: {}\n", command_line);
  return code;
}

/// @param command_line  as typed but in a shell's quotes, for the provenance of what is written;
///                      lives as long as the app
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
Command add_report(CLI::App& app);
Command add_run(CLI::App& app, const std::string& command_line);
Command add_serve(CLI::App& app);
Command add_schema(CLI::App& app);
Command add_study(CLI::App& app);
Command add_voxelise(CLI::App& app);

}  // namespace acinus::runs
