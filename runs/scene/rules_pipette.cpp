#include <fmt/format.h>

#include <algorithm>

#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

bool sucks(const PipetteBlock& p) {
  return std::ranges::any_of(p.suction.entry, [](const auto& e) { return e.value > 0; });
}

/// Checks that an experiment on a single cell has one deformable cell.
void check_single(const Scene& scene, Report& report) {
  const std::string name = "\"" + name_of_choice(scene.experiment) + "\"";
  if (scene.cells.source != CellSource::kList || scene.cells.list.size() != 1)
    report.add_relation({"/experiment", "/cells/list", "/cells"}, name,
                        "looks at one cell: give /cells/list with one entry");
  if (scene.model.value_or(scene.cells.model) == CellModel::kCbm)
    report.add_relation({"/experiment", "/cells/model"}, name,
                        "is for deformable cells: set /cells/model to \"dcm\"");
}

void check_plates(const Scene& scene, Report& report) {
  if (scene.experiment != Experiment::kPlates) return;
  check_single(scene, report);
  constexpr double kOpposite = 1e-9;
  const std::vector<WallEntry>& w = scene.walls;
  const bool face =
      w.size() == 2 && (w[0].normal.normalized() + w[1].normal.normalized()).norm() < kOpposite;
  if (!face)
    report.add_relation({"/experiment", "/walls"}, "\"plates\"",
                        "needs two walls with opposite normals, the plates (acinus explain wall)");
}

/// Checks the shape of the tube, and that it is narrower than a cell that it is to deform.
void check_tube(const Scene& scene, const PipetteBlock& p, Report& report) {
  if (!(p.axis.norm() > 0)) report.add_relation({"/pipette/axis"}, "[0, 0, 0]", "has no direction");
  for (const auto& [key, size] : {std::pair("thickness", p.thickness), {"length", p.length}})
    if (p.lip > size / 2)
      report.add_relation(
          {"/pipette/lip", std::string("/pipette/") + key}, quoted_length(p.lip),
          fmt::format("must be at most half of /pipette/{} = {}", key, quoted_length(size)));
  if (scene.experiment != Experiment::kAspiration && scene.experiment != Experiment::kNarrowGap)
    return;
  for (const auto& [name, type] : scene.cell_types)
    if (p.radius >= type.radius) {
      const std::string pointer = "/cell_types/" + name + "/radius";
      report.add_relation({"/pipette/radius", pointer}, quoted_length(p.radius),
                          fmt::format("must be below {} = {}: the cell would slip through", pointer,
                                      quoted_length(type.radius)));
    }
}

void check_suction(const Scene& scene, const PipetteBlock& p, Report& report) {
  check_course(p.suction, "/pipette/suction", report);
  if (!sucks(p)) return;
  if (scene.model.value_or(scene.cells.model) == CellModel::kCbm)
    report.add_relation({"/pipette/suction", "/cells/model"}, "",
                        "is for deformable cells: set /cells/model to \"dcm\"");
  if (scene.life.sleep)
    report.add_relation({"/pipette/suction", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

void check_experiments(const Scene& scene, Report& report) {
  const bool aspirates = scene.experiment == Experiment::kAspiration;
  if (!aspirates && scene.experiment != Experiment::kNarrowGap) return;
  check_single(scene, report);
  const std::string name = "\"" + name_of_choice(scene.experiment) + "\"";
  if (!scene.pipette) {
    report.add_relation({"/experiment", "/pipette"}, name,
                        "needs a pipette block (acinus explain pipette)");
    return;
  }
  if (sucks(*scene.pipette)) return;
  if (aspirates)
    report.add_relation({"/pipette/suction", "/pipette"}, "",
                        "needs a pressure above 0 Pa, as {\"time\": \"300 s\", \"pressure\": \"50 "
                        "Pa\"}: nothing would draw the cell in");
  else if (std::ranges::all_of(scene.cells.list,
                               [](const CellEntry& c) { return c.pull.norm() == 0; }))
    report.add_relation({"/experiment", "/pipette/suction", "/cells/list"}, name,
                        "needs something that drives the cell: /pipette/suction, or pull in "
                        "/cells/list/0");
}

}  // namespace

void check_pipette(const Scene& scene, Report& report) {
  check_plates(scene, report);
  check_experiments(scene, report);
  if (!scene.pipette) return;
  check_tube(scene, *scene.pipette, report);
  check_suction(scene, *scene.pipette, report);
}

}  // namespace acinus::runs
