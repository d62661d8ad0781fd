#include "runs/experiments/lobule_births.hpp"

#include <algorithm>
#include <optional>

#include "core/sphere.hpp"
#include "coupling/life/proliferation.hpp"
#include "coupling/migration/lesion_layers.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::runs {
namespace {

std::vector<coupling::LayerCell> layer_cells(const coupling::World& world) {
  const coupling::State& s = world.state;
  std::vector<coupling::LayerCell> cells;
  coupling::for_each_cell(s, [&](const coupling::Cell& c) {
    cells.push_back({center_of(s, c), sphere_radius(volume_of(s, c).at(s.clock.time))});
  });
  return cells;
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
    const std::optional<coupling::Cell> a = coupling::find_cell(world.state, e.cells[1]),
                                        b = coupling::find_cell(world.state, e.cells[2]);
    if (!a || !b) continue;  // a daughter that is gone already
    const int layer = layer_at(0.5 * (center_of(world.state, *a) + center_of(world.state, *b)));
    observed.births[std::min(layer, kLayers + 1) - 1] += 1;
  }
}

}  // namespace acinus::runs
