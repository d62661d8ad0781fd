#include <fmt/format.h>

#include "core/units/units.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

std::string seconds(double value) { return "\"" + format_quantity(value, kTime, "s") + "\""; }

/// Checks that series_friction is not combined with features without a memory of tensions.
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

void check_stretcher(const Scene& scene, Report& report) {
  if (scene.experiment == Experiment::kOpticalStretcher && !scene.stretcher)
    report.add_relation({"/experiment", "/stretcher"}, "\"optical_stretcher\"",
                        "needs a stretcher block (acinus explain stretcher)");
  if (!scene.stretcher) return;
  const coupling::Stretcher& s = *scene.stretcher;
  if (s.pulse.empty())
    report.add_relation({"/stretcher/pulses", "/stretcher"}, "",
                        "needs a pulse: {\"from\": \"0 s\", \"to\": \"2 s\"}");
  for (std::size_t k = 0; k < s.pulse.size(); ++k) {
    const std::string pointer = fmt::format("/stretcher/pulses/{}", k);
    if (!(s.pulse[k].from < s.pulse[k].to))
      report.add_relation(
          {pointer + "/to", pointer + "/from"}, seconds(s.pulse[k].to),
          fmt::format("must be after {}/from = {}", pointer, seconds(s.pulse[k].from)));
  }
  if (!(s.beams.cell > s.beams.medium))
    report.add_relation({"/stretcher/cell_index", "/stretcher/medium_index"},
                        fmt::format("{:g}", s.beams.cell),
                        fmt::format("must be above /stretcher/medium_index = {:g}: beams push such "
                                    "a cell out of the light",
                                    s.beams.medium));
  if (s.axis.norm() == 0) report.add_relation({"/stretcher/axis"}, "[0, 0, 0]", "has no direction");
  if (scene.model.value_or(scene.cells.model) == CellModel::kCbm)
    report.add_relation({"/stretcher", "/cells/model"}, "",
                        "is for deformable cells: set /cells/model to \"dcm\"");
  if (scene.life.sleep)
    report.add_relation({"/stretcher", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

void check_temperature(const Scene& scene, Report& report) {
  if (!scene.temperature) return;
  if (scene.temperature->course.entry.empty())
    report.add_relation({"/temperature/course", "/temperature"}, "",
                        "needs an entry: {\"time\": \"0 s\", \"value\": \"310 K\"}");
  check_course(scene.temperature->course, "/temperature/course", report);
}

}  // namespace

void check_course(const Schedule& course, const std::string& pointer, Report& report) {
  for (std::size_t k = 1; k < course.entry.size(); ++k) {
    const std::string before = fmt::format("{}/{}/time", pointer, k - 1);
    if (course.entry[k].time < course.entry[k - 1].time)
      report.add_relation(
          {fmt::format("{}/{}/time", pointer, k), before}, seconds(course.entry[k].time),
          fmt::format("must not be before {} = {}", before, seconds(course.entry[k - 1].time)));
  }
}

void check_single_cell(const Scene& scene, Report& report) {
  check_series_friction(scene, report);
  check_stretcher(scene, report);
  check_temperature(scene, report);
}

}  // namespace acinus::runs
