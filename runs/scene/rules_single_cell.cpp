#include <fmt/format.h>

#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Checks that series_friction is not combined with features without a memory of tensions.
void check_series_friction(const Scene& scene, Report& report) {
  for (const auto& [name, type] : scene.cell_types) {
    if (!(type.dcm.series_friction > 0)) continue;
    const std::string pointer = "/cell_types/" + name + "/dcm/series_friction";
    if (scene.life.sleep)
      report.add_relation({pointer, "/life/sleep"}, "",
                          "is not for cells that may sleep: tensions go on falling while a cell is "
                          "in balance. Set /life/sleep to false");
  }
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

void check_single_cell(const Scene& scene, Report& report) { check_series_friction(scene, report); }

}  // namespace acinus::runs
