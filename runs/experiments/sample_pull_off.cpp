#include <algorithm>
#include <cmath>

#include "coupling/measure/adhesion.hpp"
#include "coupling/measure/measure.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

/// Force on the pulled cell along its pull, nN.
double force_on(const coupling::Pull& pull, const ObservedFrame& f) {
  const dcm::State& cells = f.world.state.dcm;
  const auto at = std::ranges::find(cells.lineage, pull.cell);
  if (at == cells.lineage.end()) return kNotMeasured;
  const Vec3 center = dcm::cell_center(cells, at - cells.lineage.begin());
  return coupling::pull_force(pull, f.snapshot.time, center);
}

const CellType& type_of(const Scene& scene, const CellEntry& cell) {
  return cell.type.empty() ? scene.cell_types.begin()->second : scene.cell_types.at(cell.type);
}

}  // namespace

PairOfCells pair_of(const Scene& scene) {
  const CellEntry &a = scene.cells.list[0], &b = scene.cells.list[1];
  const CellType &type_a = type_of(scene, a), &type_b = type_of(scene, b);
  const double ra = a.radius.value_or(type_a.radius), rb = b.radius.value_or(type_b.radius);
  return {ra * rb / (ra + rb), std::sqrt(type_a.adhesion * type_b.adhesion)};
}

double vesicle_pull_off(const PairOfCells& pair) {
  return kPi * pair.adhesion * pair.reduced_radius;
}

void sample_pull_off(const ObservedFrame& f, Measures& m) {
  const std::vector<coupling::Pull>& pulls = f.world.params.apparatus.get<coupling::Pulls>().pull;
  const auto& cells = f.snapshot.cells;
  double force = kNotMeasured, distance = kNotMeasured, area = kNotMeasured;
  coupling::ContactTensions t;
  if (pulls.size() == 2 && cells.size() == 2) {
    force = 0.5 * (force_on(pulls[0], f) + force_on(pulls[1], f));
    distance = (cells[1].center - cells[0].center).norm();
    const coupling::Adhesion adhesion = coupling::find_adhesion(f.world, f.work);
    area = adhesion.area;
    t = coupling::find_contact_tensions(coupling::measure_nodes(f.world, f.work).tension, adhesion);
  }
  m["pull_force_nN"].push_back(force);
  m["pull_force_relative"].push_back(force / vesicle_pull_off(pair_of(f.scene)));
  m["distance_um"].push_back(distance);
  m["contact_area_um2"].push_back(area);
  m["contact_radius_um"].push_back(std::sqrt(area / kPi));
  m["tension_outside_mN_m"].push_back(t.outside);
  m["tension_contact_mN_m"].push_back(t.contact);
  m["tension_contact_min_mN_m"].push_back(t.least);
}

bool has_come_apart(const Measures& m) {
  const auto area = m.find("contact_area_um2");
  return area != m.end() && !area->second.empty() && area->second.back() == 0 &&
         std::ranges::any_of(area->second, [](double a) { return a > 0; });
}

std::optional<double> pull_off_force(const Measures& m) {
  const auto force = m.find("pull_force_nN"), area = m.find("contact_area_um2");
  if (!has_come_apart(m) || force == m.end()) return {};
  double largest = 0;
  for (std::size_t k = 0; k < force->second.size(); ++k)
    if (area->second[k] > 0) largest = std::max(largest, force->second[k]);
  return largest;
}

}  // namespace acinus::runs
