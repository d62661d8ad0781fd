#include "runs/experiments/observe.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "coupling/life/proliferation.hpp"
#include "coupling/migration/lesion_layers.hpp"
#include "runs/experiments/observables.hpp"
#include "runs/experiments/sample_lobule.hpp"
#include "runs/experiments/sample_tissue.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

using Sizes = std::map<std::string, std::size_t>;

Sizes sizes_of(const Measures& m) {
  Sizes sizes;
  for (const auto& [name, values] : m) sizes[name] = values.size();
  return sizes;
}

/// The number a series got since then, if it is one.
double latest(const Measures& m, const Sizes& before, const std::string& name) {
  const auto found = m.find(name);
  if (found == m.end() || found->second.empty()) return 0;
  const auto had = before.find(name);
  if (had != before.end() && had->second == found->second.size()) return 0;
  return std::isfinite(found->second.back()) ? found->second.back() : 0;
}

std::vector<coupling::LayerCell> layer_cells(const coupling::World& world) {
  const coupling::State& s = world.state;
  const double time = s.clock.time;
  std::vector<coupling::LayerCell> cells;
  const auto radius = [&](const Ramp& volume) {
    return std::cbrt(volume.at(time) * 3 / (4 * kPi));
  };
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l)) cells.push_back({dcm::cell_center(s.dcm, l), radius(s.dcm.volume[l])});
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    cells.push_back({cbm::center_of(s.cbm, c), radius(s.cbm.volume[c])});
  return cells;
}

/// Centre of a living cell, um.
std::optional<Vec3> find_center(const coupling::State& s, std::int64_t id) {
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l) && s.dcm.lineage[l] == id) return dcm::cell_center(s.dcm, l);
  const auto at = std::ranges::find(s.cbm.lineage, id);
  if (at == s.cbm.lineage.end()) return {};
  return cbm::center_of(s.cbm, at - s.cbm.lineage.begin());
}

}  // namespace

std::vector<io::SeriesValue> observe_frame(const ObservedFrame& frame, ObservedRun& observed) {
  Measures& m = observed.measures;
  const Sizes before = sizes_of(m);
  sample_experiment(frame.scene, frame.world, frame.snapshot, m);
  sample_tissue(frame, m);
  if (frame.scene.experiment == Experiment::kLobule) sample_lobule(frame, observed);
  if (frame.scene.experiment == Experiment::kPlates) sample_plates(frame, m);
  if (frame.scene.experiment == Experiment::kAspiration) sample_aspiration(frame, m);
  if (frame.scene.experiment == Experiment::kNarrowGap) sample_narrow_gap(frame, m);
  if (frame.scene.experiment == Experiment::kPullOff) sample_pull_off(frame, m);
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
  for (const Observable& o : columns) row.push_back({o.name, o.unit, latest(m, before, o.name)});
  return row;
}

std::string why_over(Experiment experiment, const Measures& measures) {
  const bool apart = experiment == Experiment::kPullOff && has_come_apart(measures);
  return apart ? "the cells have come apart" : "";
}

void observe_births(const Scene& scene, const coupling::World& world,
                    const coupling::LifeReport& report, ObservedRun& observed) {
  if (scene.experiment != Experiment::kLobule) return;
  // Where a rule says in which layers cells divide, they are counted as it counts them.
  const auto& rule = world.params.life.proliferation;
  std::optional<double> edge;
  std::vector<coupling::LayerCell> cells;
  const auto layer_at = [&](const Vec3& place) {
    if (rule) {
      if (!edge) edge = coupling::lesion_edge(world);
      return coupling::layer_of(*rule, *edge, place);
    }
    if (cells.empty()) cells = layer_cells(world);
    return coupling::local_layer_of({place, scene.cell_types.begin()->second.radius}, cells,
                                    scene.axis_point);
  };
  for (const coupling::LifeEvent& e : report.events) {
    if (e.kind != coupling::EventKind::kDivision || e.cells.size() != 3) continue;
    const std::optional<Vec3> a = find_center(world.state, e.cells[1]),
                              b = find_center(world.state, e.cells[2]);
    if (!a || !b) continue;  // a daughter that is gone already
    const int layer = layer_at(0.5 * (*a + *b));
    observed.births[std::min(layer, kLayers + 1) - 1] += 1;
  }
}

}  // namespace acinus::runs
