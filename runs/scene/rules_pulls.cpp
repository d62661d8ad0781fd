#include <fmt/format.h>

#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

CellModel model_of(const Scene& scene, const CellEntry& cell) {
  return cell.model.value_or(scene.model.value_or(scene.cells.model));
}

void check_pull(const Scene& scene, const PullEntry& p, const std::string& pointer,
                Report& report) {
  const auto n = static_cast<int>(scene.cells.list.size());
  if (p.cell >= n) {
    report.add_relation({pointer + "/cell", "/cells/list"}, fmt::format("{}", p.cell),
                        fmt::format("there are {} cells in /cells/list, the first is 0", n));
    return;
  }
  if (!(p.direction.norm() > 0))
    report.add_relation({pointer + "/direction"}, "[0, 0, 0]", "has no direction");
  check_course(p.force, pointer + "/force", report);
  check_course(p.displacement, pointer + "/displacement", report);
  if (p.by == PullBy::kForce && p.force.entry.empty())
    report.add_relation({pointer + "/force", pointer}, "",
                        "needs an entry: {\"time\": \"0 s\", \"force\": \"1 nN\"}");
  if (p.by == PullBy::kSpring && model_of(scene, scene.cells.list[p.cell]) != CellModel::kDcm)
    report.add_relation({pointer + "/by", "/cells/model"}, "\"spring\"",
                        "is for deformable cells: set /cells/model to \"dcm\"");
}

/// Checks that a pull-off has two cells, each with a pull of its own.
void check_pull_off(const Scene& scene, Report& report) {
  if (scene.experiment != Experiment::kPullOff) return;
  const auto& list = scene.cells.list;
  const bool pair = scene.cells.source == CellSource::kList && list.size() == 2 &&
                    model_of(scene, list[0]) == CellModel::kDcm &&
                    model_of(scene, list[1]) == CellModel::kDcm;
  if (!pair)
    report.add_relation({"/experiment", "/cells/list", "/cells"}, "\"pull_off\"",
                        "looks at two cells and is for deformable cells: give /cells/list with two "
                        "entries and set /cells/model to \"dcm\"");
  const auto& pulls = scene.pulls;
  if (pulls.size() != 2 || pulls[0].cell == pulls[1].cell)
    report.add_relation({"/experiment", "/pulls"}, "\"pull_off\"",
                        "needs two pulls, one on each cell (acinus explain pull)");
}

}  // namespace

void check_pulls(const Scene& scene, Report& report) {
  check_pull_off(scene, report);
  if (scene.pulls.empty()) return;
  if (scene.cells.source != CellSource::kList) {
    report.add_relation({"/pulls", "/cells/source"}, "", "is for cells that are listed one by one");
    return;
  }
  for (std::size_t k = 0; k < scene.pulls.size(); ++k)
    check_pull(scene, scene.pulls[k], fmt::format("/pulls/{}", k), report);
  if (scene.life.sleep)
    report.add_relation({"/pulls", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

}  // namespace acinus::runs
