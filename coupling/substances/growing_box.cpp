#include "coupling/substances/growing_box.hpp"

#include <algorithm>
#include <cmath>

#include "core/box.hpp"
#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"
#include "substances/planes.hpp"

namespace acinus::coupling {
namespace {

/// Number of layers that a face grows by at once: the solver is sized anew each time.
constexpr int kLayersAtOnce = 4;

Box box_of_cells(const State& s) {
  Box box;
  for_each_cell(s, [&](const Cell& c) {
    const double r = sphere_radius(volume_of(s, c).at(s.clock.time));
    const Box cell = sphere_box(center_of(s, c), r);
    box.include(cell.low);
    box.include(cell.high);
  });
  return box;
}

/// Layers that restore the margin.
substances::Layers find_layers(const SubstanceParams& p, const State& s) {
  const Box cells = box_of_cells(s), fields = p.grid.box();
  substances::Layers layers{};
  for (std::size_t face = 0; face < layers.size(); ++face) {
    if (!grows_at(p, face)) continue;
    const int axis = static_cast<int>(face / 2);
    const double space =
        face % 2 == 0 ? cells.low[axis] - fields.low[axis] : fields.high[axis] - cells.high[axis];
    const double lacking = (p.margin - space) / p.grid.spacing[axis];
    if (lacking > 0)
      layers[face] = kLayersAtOnce * static_cast<int>(std::ceil(lacking / kLayersAtOnce));
  }
  return layers;
}

}  // namespace

bool grows_at(const SubstanceParams& p, std::size_t face) {
  return std::ranges::all_of(p.substance, [&](const Substance& s) {
    return s.medium.face[face].kind != substances::FaceKind::kNoFlux;
  });
}

void place_fields(SubstanceParams& p, const State& s) {
  if (p.grows && !s.substance.empty())
    p.grid = substances::extend_grid(p.first_grid, s.substance.front().layers);
}

void grow_fields(World& world, const std::vector<double>& supply) {
  SubstanceParams& p = world.params.substances;
  State& s = world.state;
  if (!p.grows || count_cells(s) == 0) return;
  const substances::Layers layers = find_layers(p, s);
  if (layers == substances::Layers{}) return;
  const substances::VoxelGrid before = p.grid;
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    SubstanceState& field = s.substance[k];
    std::array<double, 6> outside{};
    for (std::size_t face = 0; face < outside.size(); ++face) {
      outside[face] = supply[k] * p.substance[k].medium.face[face].value;
      field.layers[face] += layers[face];
    }
    std::vector<double> wide =
        substances::extend_field(before, layers, field.concentration, outside);
    field.entered += before.voxel_volume() *
                     (substances::sum_numbers(wide) - substances::sum_numbers(field.concentration));
    field.concentration = std::move(wide);
  }
  place_fields(p, s);
}

}  // namespace acinus::coupling
