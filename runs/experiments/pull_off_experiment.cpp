/// Experiment "pull_off": two cells that adhere and are pulled apart by the first two pulls of the
/// scene. Contact and its tensions: coupling/measure/adhesion.hpp.

#include "runs/experiments/pull_off_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupling/apparatus/pull/pull.hpp"
#include "coupling/measure/adhesion.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/world/cell.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/experiments/single_cell.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Force on the pulled cell along its pull, nN.
double force_on(const coupling::Pull& pull, const ObservedFrame& f) {
  const coupling::State& s = f.world.state;
  const std::optional<coupling::Cell> cell = coupling::find_cell(s, pull.cell);
  if (!cell) return kNotMeasured;
  return coupling::pull_force(pull, f.snapshot.time, coupling::center_of(s, *cell));
}

const CellType& type_of(const Scene& scene, const CellEntry& cell) {
  return cell.type.empty() ? scene.cell_types.begin()->second : scene.cell_types.at(cell.type);
}

/// Rules: two deformable cells, a pull on each.
void check_pull_off(const Scene& scene, Report& report) {
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

std::vector<Observable> pull_off_columns() {
  return {
      {"pull_force_nN", "nN", "force that pulls the two cells apart, mean of the two"},
      {"pull_force_relative", "1",
       "that force over pi W R1 R2 / (R1 + R2), the pull-off force of vesicles"},
      {"distance_um", "um", "distance of the centres of the two cells"},
      {"contact_area_um2", "um^2", "area of contact, mean of the two cells"},
      {"contact_radius_um", "um", "radius of a circle with the area of contact"},
      {"tension_outside_mN_m", "mN/m", "mean surface tension outside the contact"},
      {"tension_contact_mN_m", "mN/m", "mean surface tension in the contact; 0 without contact"},
      {"tension_contact_min_mN_m", "mN/m",
       "smallest surface tension in the contact; 0 without contact"}};
}

void sample_pull_off(const std::vector<coupling::Pull>& pulls, const ObservedFrame& f,
                     Measures& m) {
  const auto& cells = f.snapshot.cells;
  double force = kNotMeasured, distance = kNotMeasured, area = kNotMeasured;
  coupling::ContactTensions t;
  if (pulls.size() == 2 && cells.size() == 2) {
    force = 0.5 * (force_on(pulls[0], f) + force_on(pulls[1], f));
    distance = (cells[1].center - cells[0].center).norm();
    const coupling::Adhesion adhesion = coupling::measure_adhesion(f.world, f.work);
    area = adhesion.area;
    t = coupling::compute_contact_tensions(coupling::measure_nodes(f.world, f.work).tension,
                                           adhesion);
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

Sampler make_pull_off_sampler(const coupling::World& world) {
  const auto& pulls = world.params.apparatus.get<coupling::Pulls>().pull;
  return [&pulls](const ObservedFrame& f, ObservedRun& observed) {
    sample_pull_off(pulls, f, observed.measures);
  };
}

std::string why_apart(const Measures& m) {
  return has_come_apart(m) ? "the cells have come apart" : "";
}

/// Largest force before the cells came apart, beside that of vesicles.
void add_pull_off_figures(const Scene& scene, const Measures& m, nlohmann::ordered_json& figures) {
  const PairOfCells pair = pair_of(scene);
  const std::optional<double> force = pull_off_force(m);
  figures["adhesion_energy_J_m2"] = finite_number(1e-3 * pair.adhesion);
  figures["radius_um"] = finite_number(pair.reduced_radius);
  figures["pull_off_nN"] = finite_number(force);
  figures["ratio_to_piWR"] = finite_number(force.value_or(kNotMeasured) / vesicle_pull_off(pair));
}

}  // namespace

PairOfCells pair_of(const Scene& scene) {
  const CellEntry &a = scene.cells.list[0], &b = scene.cells.list[1];
  const CellType &type_a = type_of(scene, a), &type_b = type_of(scene, b);
  const double ra = a.radius.value_or(type_a.radius), rb = b.radius.value_or(type_b.radius);
  return {ra * rb / (ra + rb), pair_adhesion(scene, type_a, type_b)};
}

double vesicle_pull_off(const PairOfCells& pair) {
  return kPi * pair.adhesion * pair.reduced_radius;
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

const ExperimentRow pull_off_experiment{.meaning = "force that parts two adhering cells",
                                        .check = check_pull_off,
                                        .columns = pull_off_columns,
                                        .make_sampler = make_pull_off_sampler,
                                        .why_over = why_apart,
                                        .add_figures = add_pull_off_figures};

}  // namespace acinus::runs
