/// Command `acinus permedcoe`.

#include "runs/openvt/permedcoe.hpp"

#include <memory>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "core/parallel/stop.hpp"

namespace acinus::cli {
namespace {

struct PerMedCoeArguments {
  runs::OpenVtOptions options;
  std::string what, model = "cbm", max_walltime;
};

int push(const runs::OpenVtOptions& o) {
  runs::Pushing found;
  const int code = runs::run_pushing(o, found);
  if (code == 0 && !o.quiet)
    fmt::print("distance of the centres {:.3g} um at the start, {:.3g} um after {:.3g} min\n",
               found.distance.front(), found.distance.back(), found.time.back());
  return code;
}

int grow(const std::string& what, const runs::OpenVtOptions& o) {
  runs::Growth found;
  const int code = runs::run_growth(what, o, found);
  if (code == 0 && !o.quiet)
    fmt::print("{:.0f} cells, {:.0f} um across after {:.4g} h\n", found.cells.back(),
               found.diameter.back(), found.time.back());
  return code;
}

int run(PerMedCoeArguments& a) {
  runs::OpenVtOptions& o = a.options;
  o.model =
      static_cast<runs::CellModel>(runs::choice_index(runs::kChoices<runs::CellModel>, a.model));
  const WallTimeLimit limit(read_wall_time_limit(a.max_walltime));
  if (o.out.empty()) o.out = fmt::format("permedcoe_{}_{}.run", a.what, a.model);
  const int code = a.what == "pushing" ? push(o) : grow(a.what, o);
  const std::string again = without_flag(o.command_line, "--overwrite");
  return print_how_to_continue(code, again + (o.resume ? "" : " --resume"), o.quiet);
}

}  // namespace

Command add_permedcoe(CLI::App& app, const std::string& command_line) {
  CLI::App* command = add_command(app, "permedcoe", "cases of PerMedCoE's benchmark with their CSV",
                                  "acinus permedcoe pushing --model dcm --csv distance.csv");
  const auto arguments = std::make_shared<PerMedCoeArguments>();
  runs::OpenVtOptions& o = arguments->options;
  command
      ->add_option("WHAT", arguments->what,
                   "pushing: two cells pushed together; monolayer: a layer after Bru et al.; "
                   "spheroid: a spheroid after Freyer and Sutherland")
      ->required()
      ->check(CLI::IsMember({"pushing", "monolayer", "spheroid"}));
  command->add_option("--model", arguments->model, "dcm: deformable cells; cbm: spheres (default)")
      ->type_name("MODEL")
      ->check(CLI::IsMember({"dcm", "cbm"}));
  command->add_option("--csv", o.csv, "CSV file of the result")->type_name("FILE.csv");
  command->add_option("--out", o.out, "run folder (default: permedcoe_WHAT_MODEL.run)")
      ->type_name("DIR");
  add_set(*command, o.set);
  add_threads(*command, o.threads);
  add_wall_time_limit(*command, arguments->max_walltime);
  CLI::Option* resume = command->add_flag("--resume", o.resume, "go on with what is in the folder");
  command->add_flag("--overwrite", o.overwrite, "replace what is in the folder")->excludes(resume);
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  return {command, [arguments, &command_line] {
            arguments->options.command_line = command_line;
            return cli::run(*arguments);
          }};
}

}  // namespace acinus::cli
