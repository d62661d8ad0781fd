/// Experiment "aspiration": a cell at a pipette that sucks.

#include "runs/experiments/aspiration_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupling/apparatus/suction/suction.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/experiments/single_cell.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Volume of a ball from which a plane has cut a cap with a rim of the radius `rim`, um^3.
double volume_without_cap(double radius, double rim) {
  const double height = radius - std::sqrt(radius * radius - rim * rim);
  return 4 * kPi / 3 * std::pow(radius, 3) - kPi * height * height * (radius - height / 3);
}

void check_aspiration(const Scene& scene, Report& report) {
  if (!check_pipette_experiment(scene, report) || has_suction(*scene.pipette)) return;
  report.add_relation({"/pipette/suction", "/pipette"}, "",
                      "needs a pressure above 0 Pa, as {\"time\": \"300 s\", \"pressure\": \"50 "
                      "Pa\"}: nothing would draw the cell in");
}

std::vector<Observable> aspiration_columns() {
  return {{"suction_Pa", "Pa", "pressure outside the pipette less the pressure inside"},
          {"aspirated_length_um", "um", "length of the cell inside the pipette"}};
}

void sample_aspiration(const coupling::Suction& s, const ObservedFrame& f, Measures& m) {
  const std::vector<Vec3> node = first_cell(f.world);
  double length = node.empty() ? kNotMeasured : 0;
  for (const Vec3& x : node) {
    const Vec3 d = x - s.mouth;
    if (d.cross(s.axis).norm() < s.reach) length = std::max(length, d.dot(s.axis));
  }
  m["suction_Pa"].push_back(1e3 * s.load_at(f.snapshot.time).pressure);
  m["aspirated_length_um"].push_back(length);
}

Sampler make_aspiration_sampler(const coupling::World& world) {
  const auto& suction = world.params.apparatus.get<coupling::Suction>();
  return [&suction](const ObservedFrame& f, ObservedRun& observed) {
    sample_aspiration(suction, f, observed.measures);
  };
}

/// Critical pressure, beside that of a surface with the tension of the cell's type.
void add_aspiration_figures(const Scene& scene, const Measures& m,
                            nlohmann::ordered_json& figures) {
  const CellType& type = scene.cell_types.begin()->second;
  const std::optional<double> suction = critical_suction(*scene.pipette, m);
  figures["critical_pressure_Pa"] = finite_number(1e3 * suction.value_or(kNotMeasured));
  figures["closed_form_critical_pressure_Pa"] = finite_number(
      1e3 * closed_form_suction(type.dcm.cortex_tension, scene.pipette->radius, type.radius));
}

}  // namespace

double closed_form_suction(double tension, double pipette_radius, double cell_radius) {
  const double rest =
      4 * kPi / 3 * std::pow(cell_radius, 3) - 2 * kPi / 3 * std::pow(pipette_radius, 3);
  // The volume grows with the radius, and the ball is never larger than the cell and its cap.
  double low = pipette_radius, high = 2 * cell_radius;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (volume_without_cap(middle, pipette_radius) < rest ? low : high) = middle;
  }
  return 2 * tension * (1 / pipette_radius - 1 / low);
}

std::optional<double> critical_suction(const PipetteBlock& p, const Measures& m) {
  const double wanted = p.radius + p.lip;
  const auto pressure = m.find("suction_Pa"), length = m.find("aspirated_length_um");
  if (pressure == m.end() || length == m.end()) return {};
  for (std::size_t k = 1; k < length->second.size(); ++k) {
    const double a = length->second[k - 1], b = length->second[k];
    if (!(b >= wanted && a < wanted)) continue;
    const double pa = pressure->second[k - 1], pb = pressure->second[k];
    return 1e-3 * (pa + (pb - pa) * (wanted - a) / (b - a));
  }
  return {};
}

const ExperimentRow aspiration_experiment{.meaning = "aspiration of a cell into a micropipette",
                                          .check = check_aspiration,
                                          .columns = aspiration_columns,
                                          .make_sampler = make_aspiration_sampler,
                                          .add_figures = add_aspiration_figures};

}  // namespace acinus::runs
