#include <fmt/format.h>

#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Rules of cortices that flow, whose tensions depend on the past.
void check_series_friction(const Scene& scene, Report& report) {
  for (const auto& [name, type] : scene.cell_types) {
    if (!(type.dcm.series_friction > 0)) continue;
    const std::string pointer = "/cell_types/" + name + "/dcm/series_friction";
    if (scene.numerics.integrator == coupling::Integrator::kRos2)
      report.add_relation({pointer, "/time/integrator"}, "",
                          "is not for \"ros2\". Choose \"linearly-implicit\"");
    if (scene.life.sleep)
      report.add_relation({pointer, "/life/sleep"}, "",
                          "is not for cells that may sleep: tensions go on falling while a cell is "
                          "in balance. Set /life/sleep to false");
  }
}

void check_plates(const Scene& scene, Report& report) {
  if (scene.experiment != Experiment::kPlates) return;
  check_one_cell(scene, report);
  constexpr double kOpposite = 1e-9;
  const std::vector<WallEntry>& w = scene.walls;
  const bool face =
      w.size() == 2 && (w[0].normal.normalized() + w[1].normal.normalized()).norm() < kOpposite;
  if (!face)
    report.add_relation({"/experiment", "/walls"}, "\"plates\"",
                        "needs two walls with opposite normals, the plates (acinus explain wall)");
}

}  // namespace

void check_course(const Schedule& course, const std::string& pointer, Report& report) {
  for (std::size_t k = 1; k < course.entry.size(); ++k) {
    const std::string before = fmt::format("{}/{}/time", pointer, k - 1);
    if (course.entry[k].time < course.entry[k - 1].time)
      report.add_relation(
          {fmt::format("{}/{}/time", pointer, k), before}, quoted_time(course.entry[k].time),
          fmt::format("must not be before {} = {}", before, quoted_time(course.entry[k - 1].time)));
  }
}

void check_one_cell(const Scene& scene, Report& report) {
  const std::string name = "\"" + name_of_choice(scene.experiment) + "\"";
  if (scene.cells.source != CellSource::kList || scene.cells.list.size() != 1)
    report.add_relation({"/experiment", "/cells/list", "/cells"}, name,
                        "looks at one cell: give /cells/list with one entry");
  if (scene.model.value_or(scene.cells.model) == CellModel::kCbm)
    report.add_relation({"/experiment", "/cells/model"}, name,
                        "is for deformable cells: set /cells/model to \"dcm\"");
}

void check_single_cell(const Scene& scene, Report& report) {
  check_series_friction(scene, report);
  check_plates(scene, report);
}

}  // namespace acinus::runs
