/// Command `acinus openvt`.

#include "runs/openvt/openvt.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "core/parallel/stop.hpp"

namespace acinus::cli {
namespace {

struct OpenVtArguments {
  runs::OpenVtOptions openvt;
  std::string what, model = "cbm", max_walltime;
};

int relax(const runs::OpenVtOptions& o) {
  runs::RowLength row;
  const int code = runs::run_relaxation(o, row);
  if (code == 0 && !o.quiet)
    fmt::print("90 % of the length after {:.1f} min\n", runs::time_to_90_percent(row) / 60);
  return code;
}

int grow(const runs::OpenVtOptions& o) {
  runs::Layer layer;
  const int code = runs::run_monolayer(o, layer);
  if (code != 0 || o.quiet) return code;
  double reach = 0, rim = 0, area = 0;
  for (std::size_t k = 0; k < layer.cell.size(); ++k) {
    reach = std::max(reach, std::hypot(layer.cell[k].x, layer.cell[k].y));
    rim += layer.free[k].rim;
    area += layer.free[k].area;
  }
  const auto n = static_cast<double>(layer.cell.size());
  fmt::print(
      "{} cells within {:.0f} um, cycle {:.1f} h; free of rim {:.3f}, of area {:.3f} in the "
      "mean\n",
      layer.cell.size(), reach, layer.cycle / 3600, rim / n, area / n);
  return code;
}

int sort(const std::string& what, const runs::OpenVtOptions& o) {
  runs::MixedShare found;
  const int code = runs::run_sorting(what, o, found);
  if (code == 0 && !o.quiet)
    fmt::print(
        "contacts of unlike cells: {:.3f} of all at the start, {:.3f} after {:.0f} units of "
        "time\n",
        found.mixed.front(), found.mixed.back(), found.time.back());
  return code;
}

int run(OpenVtArguments& a) {
  a.openvt.model =
      static_cast<runs::CellModel>(runs::choice_index(runs::kChoices<runs::CellModel>, a.model));
  const WallTimeLimit limit(read_wall_time_limit(a.max_walltime));
  check(a.what == "monolayer" || !a.openvt.cells,
        "--cells is for monolayer: the others have a fixed number. Leave it out.");
  if (a.openvt.out.empty()) a.openvt.out = fmt::format("openvt_{}_{}.run", a.what, a.model);
  const int code = a.what == "relax11"     ? relax(a.openvt)
                   : a.what == "monolayer" ? grow(a.openvt)
                                           : sort(a.what, a.openvt);
  const std::string again = without_flag(a.openvt.command_line, "--overwrite");
  return print_how_to_continue(code, again + (a.openvt.resume ? "" : " --resume"), a.openvt.quiet);
}

}  // namespace

Command add_openvt(CLI::App& app, const std::string& command_line) {
  CLI::App* command = add_command(app, "openvt", "reference models of OpenVT with their CSV",
                                  "acinus openvt relax11 --model dcm --csv row.csv");
  const auto arguments = std::make_shared<OpenVtArguments>();
  runs::OpenVtOptions& o = arguments->openvt;
  command
      ->add_option("WHAT", arguments->what,
                   "relax11: a row of eleven cells; monolayer: a thousand cells from one; sorting, "
                   "engulfment, checkerboard: two types of cells in a layer")
      ->required()
      ->check(CLI::IsMember({"relax11", "monolayer", "sorting", "engulfment", "checkerboard"}));
  command->add_option("--model", arguments->model, "dcm: deformable cells; cbm: spheres (default)")
      ->type_name("MODEL")
      ->check(CLI::IsMember({"dcm", "cbm"}));
  command->add_option("--csv", o.csv, "CSV file in OpenVT's format")->type_name("FILE.csv");
  command->add_option("--out", o.out, "folder of the runs (default: openvt_WHAT_MODEL.run)")
      ->type_name("DIR");
  command->add_option("--cells", o.cells, "monolayer: until there are so many (default: 1000)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  add_set(*command, o.set);
  add_threads(*command, o.threads);
  add_wall_time_limit(*command, arguments->max_walltime);
  CLI::Option* resume = command->add_flag("--resume", o.resume, "go on with what is in the folder");
  command->add_flag("--overwrite", o.overwrite, "replace what is in the folder")->excludes(resume);
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  return {command, [arguments, &command_line] {
            arguments->openvt.command_line = command_line;
            return cli::run(*arguments);
          }};
}

}  // namespace acinus::cli
