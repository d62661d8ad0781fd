#include "cli/published_case.hpp"

#include "cli/wall_time.hpp"
#include "core/parallel/stop.hpp"

namespace acinus::cli {

void add_case_options(CLI::App& command, const std::string& name, const std::string& csv_meaning,
                      CaseArguments& arguments) {
  runs::OpenVtOptions& o = arguments.options;
  command.add_option("--model", arguments.model, "dcm: deformable cells; cbm: spheres (default)")
      ->type_name("MODEL")
      ->check(CLI::IsMember({"dcm", "cbm"}));
  command.add_option("--csv", o.csv, csv_meaning)->type_name("FILE.csv");
  command
      .add_option("--out", o.out,
                  fmt::format("folder of the runs (default: {}_WHAT_MODEL.run)", name))
      ->type_name("DIR");
  add_set(command, o.set);
  add_threads(command, o.threads);
  add_wall_time_limit(command, arguments.max_walltime);
  CLI::Option* resume = command.add_flag("--resume", o.resume, "go on with what is in the folder");
  command.add_flag("--overwrite", o.overwrite, "replace what is in the folder")->excludes(resume);
  command.add_flag("--quiet", o.quiet, "warnings and errors only");
}

int run_case(const std::string& name, CaseArguments& arguments,
             const std::function<int(const std::string& what, const runs::OpenVtOptions&)>& run) {
  runs::OpenVtOptions& o = arguments.options;
  o.model = static_cast<runs::CellModel>(
      runs::choice_index(runs::kChoices<runs::CellModel>, arguments.model));
  const WallTimeLimit limit(read_wall_time_limit(arguments.max_walltime));
  if (o.out.empty()) o.out = fmt::format("{}_{}_{}.run", name, arguments.what, arguments.model);
  const int code = run(arguments.what, o);
  const std::string again = without_flag(o.command_line, "--overwrite");
  return print_how_to_continue(code, again + (o.resume ? "" : " --resume"), o.quiet);
}

}  // namespace acinus::cli
