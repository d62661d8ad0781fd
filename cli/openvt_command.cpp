/// Command `acinus openvt`.

#include "runs/openvt/openvt.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/published_case.hpp"
#include "core/error.hpp"

namespace acinus::cli {
namespace {

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

int run_openvt(const std::string& what, const runs::OpenVtOptions& o) {
  check(what == "monolayer" || !o.cells,
        "--cells is for monolayer: the others have a fixed number. Leave it out.");
  return what == "relax11" ? relax(o) : what == "monolayer" ? grow(o) : sort(what, o);
}

}  // namespace

Command add_openvt(CLI::App& app, const std::string& command_line) {
  CLI::App* command = add_command(app, "openvt", "reference models of OpenVT with their CSV",
                                  "acinus openvt relax11 --model dcm --csv row.csv");
  const auto arguments = std::make_shared<CaseArguments>();
  command
      ->add_option("WHAT", arguments->what,
                   "relax11: a row of eleven cells; monolayer: a thousand cells from one; sorting, "
                   "engulfment, checkerboard: two types of cells in a layer")
      ->required()
      ->check(CLI::IsMember({"relax11", "monolayer", "sorting", "engulfment", "checkerboard"}));
  add_case_options(*command, "openvt", "CSV file in OpenVT's format", *arguments);
  command
      ->add_option("--cells", arguments->options.cells,
                   "monolayer: until there are so many (default: 1000)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  return {command, [arguments, &command_line] {
            arguments->options.command_line = command_line;
            return run_case("openvt", *arguments, run_openvt);
          }};
}

}  // namespace acinus::cli
