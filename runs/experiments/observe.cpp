#include "runs/experiments/observe.hpp"

#include <cmath>
#include <map>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/observables.hpp"
#include "runs/experiments/sample_tissue.hpp"

namespace acinus::runs {
namespace {

using Sizes = std::map<std::string, std::size_t>;

Sizes sizes_of(const Measures& m) {
  Sizes sizes;
  for (const auto& [name, values] : m) sizes[name] = values.size();
  return sizes;
}

/// Number a series got since then; 0 if it got none.
double latest(const Measures& m, const Sizes& before, const std::string& name) {
  const auto found = m.find(name);
  if (found == m.end() || found->second.empty()) return 0;
  const auto had = before.find(name);
  if (had != before.end() && had->second == found->second.size()) return 0;
  return std::isfinite(found->second.back()) ? found->second.back() : 0;
}

}  // namespace

bool reads_points(const Scene& scene, const coupling::World& world) {
  return !experiment_row(scene.experiment).reads_snapshot_only || samples_points(world);
}

std::vector<io::SeriesValue> observe_frame(const ObservedFrame& frame, ObservedRun& observed) {
  Measures& m = observed.measures;
  const Sizes before = sizes_of(m);
  sample_experiment(frame, observed);
  sample_tissue(frame, m);
  observed.last_time = frame.snapshot.time;
  observed.track.clear();
  for (const coupling::CellMeasure& c : frame.snapshot.cells)
    observed.track[c.id] = {c.center, c.leader};

  std::vector<io::SeriesValue> row{{"time", "s", frame.snapshot.time}};
  std::vector<Observable> columns = known_observables(frame.scene.experiment);
  for (const std::string& wall : wall_names(frame.world.params.boundary)) {
    const std::vector<Observable> of_wall = wall_observables(wall);
    columns.insert(columns.end(), of_wall.begin(), of_wall.end());
  }
  for (const coupling::Substance& s : frame.world.params.substances.substance) {
    const std::vector<Observable> of_substance = substance_observables(s.name, s.unit);
    columns.insert(columns.end(), of_substance.begin(), of_substance.end());
  }
  for (std::size_t k = 0; k < frame.scene.rules.size(); ++k) {
    const std::vector<Observable> of_rule = rule_observables(k);
    columns.insert(columns.end(), of_rule.begin(), of_rule.end());
  }
  for (const Observable& o : columns) row.push_back({o.name, o.unit, latest(m, before, o.name)});
  return row;
}

std::string why_over(Experiment experiment, const Measures& measures) {
  const auto why = experiment_row(experiment).why_over;
  return why ? why(measures) : "";
}

bool counts_births(const Scene& scene) {
  return experiment_row(scene.experiment).count_births != nullptr;
}

void observe_births(const Scene& scene, const coupling::World& world,
                    const coupling::LifeReport& report, ObservedRun& observed) {
  const auto count_births = experiment_row(scene.experiment).count_births;
  if (count_births) count_births(scene, world, report, observed);
}

}  // namespace acinus::runs
