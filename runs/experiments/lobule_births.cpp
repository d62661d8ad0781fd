#include "runs/experiments/lobule_births.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupling/life/proliferation.hpp"
#include "coupling/migration/lesion_layers.hpp"

namespace acinus::runs {
namespace {

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

void count_births_by_layer(const Scene& scene, const coupling::World& world,
                           const coupling::LifeReport& report, ObservedRun& observed) {
  // Layers are those of the rule of proliferation if the scene has it.
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
