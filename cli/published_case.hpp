#pragma once
/// Options and course that the commands of published cases share: `acinus openvt`, `acinus
/// permedcoe`.

#include <functional>
#include <string>

#include "cli/command.hpp"
#include "runs/openvt/openvt.hpp"

namespace acinus::cli {

/// Arguments of one command.
struct CaseArguments {
  runs::OpenVtOptions options;
  std::string what, model = "cbm", max_walltime;
};

/// Adds all options but the name of the case.
/// @param name         of the command; begins the default name of the run folder
/// @param csv_meaning  help text of --csv
void add_case_options(CLI::App& command, const std::string& name, const std::string& csv_meaning,
                      CaseArguments& arguments);

/// Runs a case, and prints how to continue it where it was stopped.
/// @param run  runs the case of this name
/// @return exit code of `run`
int run_case(const std::string& name, CaseArguments& arguments,
             const std::function<int(const std::string& what, const runs::OpenVtOptions&)>& run);

}  // namespace acinus::cli
