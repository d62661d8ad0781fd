/// Rules of the zoom, its regions and the cells, vessels and lesions that they follow.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/units/units.hpp"
#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

std::string pressure(double value) { return "\"" + format_quantity(value, kStress, "Pa") + "\""; }

/// Largest number of cells at the start; unbounded for meshes, whose number stands in a file.
std::int64_t count_cells(const Scene& scene) {
  const CellsBlock& c = scene.cells;
  if (c.source == CellSource::kList) return std::ssize(c.list);
  if (c.source == CellSource::kBox) return std::int64_t{1} * c.grid[0] * c.grid[1] * c.grid[2];
  if (c.source == CellSource::kMeshes) return std::numeric_limits<std::int64_t>::max();
  return c.source == CellSource::kLobule && scene.lobule ? scene.lobule->cells : c.count;
}

void check_followed_cells(const Scene& scene, const Region& r, const std::string& pointer,
                          Report& report) {
  const std::int64_t n = count_cells(scene);
  if (r.cells.empty())
    report.add_relation({pointer + "/cells"}, "[]", "follows no cell: name at least one");
  for (std::size_t k = 0; k < r.cells.size(); ++k)
    if (r.cells[k] >= n)
      report.add_relation(
          {fmt::format("{}/cells/{}", pointer, k), pointer + "/cells"},
          fmt::format("{}", r.cells[k]),
          fmt::format("is no cell of the start: their numbers go from 0 to {}", n - 1));
}

/// Checks that the scene has the cells, vessels or lesion that a region follows.
void check_following(const Scene& scene, const Region& r, const std::string& pointer,
                     Report& report) {
  const std::string kind = "\"" + name_of_choice(r.kind) + "\"";
  if (r.kind == RegionKind::kFront && !scene.lobule)
    report.add_relation({pointer + "/kind", "/lobule"}, kind,
                        "follows the edge of a lesion, and there is none without a lobule block");
  if (r.kind == RegionKind::kVessel && scene.vessels.file.empty() && !scene.lobule)
    report.add_relation({pointer + "/kind", "/vessels/file", "/lobule"}, kind,
                        "needs vessels: give /vessels/file or a lobule block");
  if (r.kind == RegionKind::kCells) check_followed_cells(scene, r, pointer, report);
  if (r.kind == RegionKind::kPressure && r.below >= r.above)
    report.add_relation({pointer + "/below", pointer + "/above"}, pressure(r.below),
                        fmt::format("must be less than {}/above = {}, or cells change to and fro",
                                    pointer, pressure(r.above)));
}

void check_moving(const Scene& scene, Report& report) {
  const MovingZoomBlock& zoom = *scene.moving_zoom;
  const CellModel model = model_of(scene);
  if (scene.zoom.empty())
    report.add_relation({"/moving_zoom", "/zoom"}, "",
                        "has no region to follow. Give /zoom at least one");
  if (model == CellModel::kZoom || scene.zoom.empty()) {
    double diameter = 0;
    for (const auto& [name, type] : scene.cell_types)
      diameter = std::max(diameter, 2 * type.radius);
    if (zoom.margin < diameter)
      report.add_relation({"/moving_zoom/margin", "/moving_zoom"}, quoted_length(zoom.margin),
                          fmt::format("must be at least a cell diameter, {}, or cells at the edge "
                                      "change to and fro",
                                      quoted_length(diameter)));
  }
  if (scene.numerics.integrator != coupling::Integrator::kLinearlyImplicit)
    report.add_relation({"/time/integrator", "/moving_zoom"},
                        "\"" + name_of_choice(scene.numerics.integrator) + "\"",
                        "cannot follow cells that change their model (/moving_zoom). Choose "
                        "\"linearly-implicit\"");
}

}  // namespace

void check_zoom(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.zoom.size(); ++i) {
    const std::string pointer = fmt::format("/zoom/{}", i);
    const Region& r = scene.zoom[i];
    check_region(r, pointer, report);
    if (!coupling::moves(r.kind)) continue;
    if (!scene.moving_zoom)
      report.add_relation({pointer + "/kind", "/moving_zoom"}, "\"" + name_of_choice(r.kind) + "\"",
                          "moves with the tissue: give a moving_zoom block that says how often "
                          "cells are looked at (acinus explain moving_zoom)");
    check_following(scene, r, pointer, report);
  }
  if (scene.moving_zoom) check_moving(scene, report);
}

}  // namespace acinus::runs
