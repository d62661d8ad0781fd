/// Experiment "narrow_gap": a cell that is driven through the hole of a short pipette.

#include "runs/experiments/narrow_gap_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/experiments/single_cell.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Area of the section of a closed surface by the plane through `point` across `axis`, um^2.
double section_area(std::span<const Vec3> node, const geometry::Topology& t, const Vec3& point,
                    const Vec3& axis) {
  double area = 0;
  for (const auto& corner : t.triangle) {
    // Every triangle that is cut has one edge through which the plane goes up and one down; from
    // one to the other the outline runs round the section.
    Vec3 up = Vec3::Zero(), down = Vec3::Zero();
    bool cut = false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = node[corner[k]] - point, b = node[corner[(k + 1) % 3]] - point;
      const double from = a.dot(axis), to = b.dot(axis);
      if ((from > 0) == (to > 0)) continue;
      (from > 0 ? down : up) = a + from / (from - to) * (b - a);
      cut = true;
    }
    if (cut) area += 0.5 * axis.dot(up.cross(down));
  }
  return std::abs(area);
}

void check_narrow_gap(const Scene& scene, Report& report) {
  if (!check_pipette_experiment(scene, report) || has_suction(*scene.pipette)) return;
  if (std::ranges::all_of(scene.cells.list, [](const CellEntry& c) { return c.pull.norm() == 0; }))
    report.add_relation({"/experiment", "/pipette/suction", "/cells/list"}, "\"narrow_gap\"",
                        "needs something that drives the cell: /pipette/suction, or pull in "
                        "/cells/list/0");
}

std::vector<Observable> narrow_gap_columns() {
  return {{"position_um", "um", "the cell's centre along the axis of the hole, from its mouth"},
          {"length_um", "um", "extent of the cell along the axis"},
          {"width_um", "um", "mean extent of the cell across the axis"},
          {"waist_um", "um",
           "diameter of a circle with the area of the cell's section halfway through the hole"},
          {"passed", "1", "1 once all of the cell is beyond the hole"}};
}

void sample_narrow_gap(const ObservedFrame& f, ObservedRun& observed) {
  Measures& m = observed.measures;
  const std::vector<Vec3> node = first_cell(f.world);
  const auto& pipettes = f.world.params.boundary.pipettes;
  double position = kNotMeasured, length = kNotMeasured, width = kNotMeasured, waist = kNotMeasured,
         passed = kNotMeasured;
  if (!node.empty() && !pipettes.empty()) {
    const contact::Pipette& hole = pipettes.front();
    const auto along = [&](const Vec3& x) { return (x - hole.mouth).dot(hole.axis); };
    const Vec3& last = *std::ranges::min_element(node, {}, along);
    position = along(dcm::cell_center(f.world.state.dcm, 0));
    length = extent(node, hole.axis);
    width = extent_across(node, hole.axis);
    waist = 2 * std::sqrt(section_area(node, *f.world.state.dcm.group[0].topology,
                                       hole.mouth + hole.length / 2 * hole.axis, hole.axis) /
                          kPi);
    passed = along(last) > hole.length ? 1 : 0;
  }
  m["position_um"].push_back(position);
  m["length_um"].push_back(length);
  m["width_um"].push_back(width);
  m["waist_um"].push_back(waist);
  m["passed"].push_back(passed);
}

void add_passage_figures(const Scene&, const Measures& m, nlohmann::ordered_json& figures) {
  figures["passage_h"] = finite_number(passage_time(m));
}

}  // namespace

std::optional<double> passage_time(const Measures& m) {
  const auto at = m.find("position_um"), size = m.find("length_um"), passed = m.find("passed"),
             time = m.find("time_s");
  if (at == m.end() || size == m.end() || passed == m.end() || time == m.end()) return {};
  std::optional<double> enters;
  for (std::size_t k = 0; k < at->second.size(); ++k) {
    if (!enters && at->second[k] + size->second[k] / 2 > 0) enters = time->second[k];
    if (passed->second[k] == 1) return (time->second[k] - enters.value_or(0)) / 3600;
  }
  return {};
}

const ExperimentRow narrow_gap_experiment{
    .meaning = "passage of a cell through a hole narrower than itself",
    .check = check_narrow_gap,
    .columns = narrow_gap_columns,
    .sample = sample_narrow_gap,
    .add_figures = add_passage_figures};

}  // namespace acinus::runs
