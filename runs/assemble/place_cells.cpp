#include "runs/assemble/place_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/nearest_gap.hpp"
#include "core/error.hpp"
#include "core/numbers/random.hpp"
#include "core/sphere.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/zoom/regions.hpp"
#include "geometry/bodies.hpp"
#include "geometry/box_pairs.hpp"
#include "geometry/measures.hpp"
#include "geometry/readers/read_surface.hpp"
#include "runs/assemble/cell_types.hpp"

namespace acinus::runs {
namespace {

/// Largest overlap of a starting cell with an obstacle, um; contact forces resolve it in the first
/// steps.
constexpr double kMostStartOverlap = 0.3;

double start_radius(const Scene& scene, double radius) {
  return scene.start_up.enabled ? scene.start_up.initial_radius : radius;
}

/// Bounds of radius and coordinates, um. Values beyond them are mistaken units; the run file stores
/// single precision.
constexpr double kSmallestRadius = 0.01, kLargestRadius = 1e4,
                 kLargestCoordinateOfCell = 1e6;  // um

/// Largest start radius of a cell type, um: cells at a random point of their cycle have up to twice
/// the volume.
double largest_start(const CellType& t) {
  return t.radius * (t.cycle.time > 0 && t.cycle.random_start ? std::cbrt(2.0) : 1);
}

/// Random sequential addition of centres in a box, at least cells.min_distance apart and clear of
/// the boundary.
/// @return [cells.count] um
/// @throws Error if the box cannot hold them
std::vector<Vec3> fill_box(const Scene& scene, const contact::Boundary& boundary) {
  const CellsBlock& c = scene.cells;
  UniformStream random(scene.seed, Purpose::kPlacement, 0);
  std::vector<Vec3> seeds;
  constexpr int kMostTries = 200000;
  for (int tries = 0; tries < kMostTries && static_cast<int>(seeds.size()) < c.count; ++tries) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random.uniform(c.low[k], c.high[k]);
    const bool free =
        std::ranges::all_of(seeds, [&](const Vec3& y) { return (x - y).norm() >= c.min_distance; });
    if (!free) continue;
    // The next cell's type hangs on its number: large cells are not rarer for the volume they need.
    const CellType& type = scene.cell_types.at(draw_cell_type(scene, std::ssize(seeds), x));
    if (contact::nearest_gap(boundary, x) < start_radius(scene, largest_start(type))) continue;
    seeds.push_back(x);
    tries = 0;
  }
  check(static_cast<int>(seeds.size()) == c.count,
        fmt::format("{}: /cells/count: space for only {} of {} cells at least {} um apart between "
                    "{} and {} um. "
                    "Lower count or min_distance, or enlarge low and high.",
                    scene.file, seeds.size(), c.count, c.min_distance,
                    fmt::format("({}, {}, {})", c.low.x(), c.low.y(), c.low.z()),
                    fmt::format("({}, {}, {})", c.high.x(), c.high.y(), c.high.z())));
  return seeds;
}

/// Name of a placed cell in messages: its entry of cells.list or its number.
std::string name_of(const Scene& scene, const PlacedCell& cell) {
  return fmt::format("{}{}",
                     scene.cells.source == CellSource::kList ? "/cells/list/" : "generated cell ",
                     cell.lineage);
}

/// Pairs of cells whose centres are closer than half the larger radius, as ascending indices into
/// the list.
std::vector<std::pair<int, int>> find_crowded(const Scene& scene,
                                              const std::vector<PlacedCell>& cells) {
  std::vector<Box> boxes;
  for (const PlacedCell& c : cells)
    boxes.push_back(sphere_box(c.center, 0.5 * start_radius(scene, c.radius)));
  std::vector<std::pair<int, int>> pairs = geometry::find_pairs(boxes, 0);
  std::erase_if(pairs, [&](const std::pair<int, int>& pair) {
    const PlacedCell &p = cells[pair.first], &q = cells[pair.second];
    return (p.center - q.center).norm() >=
           0.5 * std::max(start_radius(scene, p.radius), start_radius(scene, q.radius));
  });
  return pairs;
}

/// Checks radius and position of every cell against the bounds above, before they overflow
/// elsewhere.
void check_sizes(const Scene& scene, const std::vector<PlacedCell>& cells) {
  for (const PlacedCell& c : cells) {
    if (!(c.radius >= kSmallestRadius && c.radius <= kLargestRadius))
      throw Error(fmt::format(
          "{}: {} has the radius {:.4g} um; from {} to {} um is allowed. Check its unit.",
          scene.file, name_of(scene, c), c.radius, kSmallestRadius, kLargestRadius));
    if (!(c.center.cwiseAbs().maxCoeff() <= kLargestCoordinateOfCell))
      throw Error(
          fmt::format("{}: {} is at ({:.4g}, {:.4g}, {:.4g}) um; at most {:g} um from the origin "
                      "along each axis "
                      "is allowed. Check its unit.",
                      scene.file, name_of(scene, c), c.center.x(), c.center.y(), c.center.z(),
                      kLargestCoordinateOfCell));
  }
}

PlacedCell make_cell(const Scene& scene, const CellEntry& e) {
  PlacedCell p;
  p.center = e.position;
  p.type = e.type.empty() ? scene.cell_types.begin()->first : e.type;
  p.radius = e.radius.value_or(scene.cell_types.at(p.type).radius);
  p.pull = e.pull;
  p.oriented = !e.random_orientation;
  return p;
}

/// Centres of generated cells in the order of their numbers, um.
std::vector<Vec3> generate_centers(const Scene& scene, const coupling::Lobule* lobule,
                                   std::span<const geometry::Surface> surface,
                                   const contact::Boundary& boundary) {
  const CellsBlock& c = scene.cells;
  const double diameter = 2 * largest_radius(scene);
  UniformStream stream(scene.seed, Purpose::kJitter, 0);
  const coupling::Uniform uniform = [&stream] { return stream.uniform(); };
  std::vector<Vec3> centers;
  switch (c.source) {
    case CellSource::kClump:
      return coupling::make_clump({c.lattice, c.count, c.spacing * diameter, c.jitter * diameter},
                                  uniform);
    case CellSource::kBox:
      return coupling::make_box(
          {coupling::BoxPacking::kCubic, c.grid, c.spacing * diameter, c.jitter * diameter},
          uniform);
    case CellSource::kFill:
      return fill_box(scene, boundary);
    case CellSource::kMeshes:
      for (const geometry::Surface& s : surface)
        centers.push_back(geometry::compute_centroid(s.node, s.triangle));
      break;
    case CellSource::kLobule:
      if (lobule) centers = lobule->seeds;
      break;
    case CellSource::kList:
      break;
  }
  return centers;
}

/// Generated cell at a centre.
/// @param number  index in the order of generation
/// @param shape   surface of the cell, null if it has none
PlacedCell generate_cell(const Scene& scene, std::int64_t number, const Vec3& center,
                         const geometry::Surface* shape) {
  PlacedCell p;
  p.center = center;
  p.type = draw_cell_type(scene, number, center);
  p.radius = shape ? sphere_radius(geometry::compute_volume(shape->node, shape->triangle))
                   : scene.cell_types.at(p.type).radius;
  p.oriented = false;
  p.shaped = shape != nullptr;
  return p;
}

/// Chooses the model of zoomed cells: deformable within a region, else a sphere.
/// @param zoomed  indices into cells
void choose_models(const Scene& scene, const geometry::Network& vessels,
                   const std::vector<std::size_t>& zoomed, std::vector<PlacedCell>& cells) {
  if (zoomed.empty()) return;
  std::vector<coupling::ZoomCell> all;
  for (const PlacedCell& c : cells) {
    coupling::ZoomCell z;
    z.center = c.center;
    z.radius = c.radius;
    z.lineage = c.lineage;
    all.push_back(z);
  }
  coupling::ZoomParams zoom;
  zoom.region = scene.zoom;
  zoom.axis_point = scene.axis_point;
  const std::vector<double> distance = coupling::distances_from_zoom(zoom, vessels, all);
  for (const std::size_t k : zoomed) cells[k].deformable = distance[k] <= 0;
}

}  // namespace

std::vector<geometry::Surface> read_cell_surfaces(const Scene& scene) {
  if (scene.cells.source != CellSource::kMeshes) return {};
  std::vector<geometry::Surface> bodies =
      geometry::read_closed_surfaces(scene.cells.file, scene.cells.unit);
  const geometry::Nested n = geometry::find_nested(bodies);
  check(n.inner < 0,
        fmt::format("{}: body {} lies inside body {}: a nucleus or another inner surface. Every "
                    "surface is a cell here: leave inner ones out; nuclei are a setting of the "
                    "cell type (dcm.nucleus).",
                    scene.cells.file, n.inner, n.outer));
  return bodies;
}

std::vector<PlacedCell> place_cells(const Scene& scene, const coupling::Lobule* lobule,
                                    std::span<const geometry::Surface> surface,
                                    const contact::Boundary& boundary) {
  const CellsBlock& c = scene.cells;
  const CellModel model = model_of(scene);
  std::vector<PlacedCell> cells;
  std::vector<std::size_t> zoomed;
  const auto add = [&](PlacedCell p, CellModel own) {
    p.lineage = std::ssize(cells);
    p.deformable = own == CellModel::kDcm;
    if (own == CellModel::kZoom) zoomed.push_back(cells.size());
    cells.push_back(std::move(p));
  };
  if (c.source == CellSource::kList) {
    for (const CellEntry& e : c.list) add(make_cell(scene, e), e.model.value_or(model));
  } else {
    for (const Vec3& x : generate_centers(scene, lobule, surface, boundary)) {
      const geometry::Surface* shape =
          c.source == CellSource::kMeshes ? &surface[cells.size()] : nullptr;
      add(generate_cell(scene, std::ssize(cells), x, shape), model);
    }
  }
  choose_models(scene, boundary.vessels.network, zoomed, cells);
  return cells;
}

void check_starts(const Scene& scene, const std::vector<PlacedCell>& cells,
                  const contact::Boundary& boundary) {
  check_sizes(scene, cells);
  std::string message;
  int bad = 0;
  for (const PlacedCell& c : cells) {
    std::string name;
    // Of a cell with a given shape only the centre is checked.
    const double r = c.shaped ? kMostStartOverlap : start_radius(scene, c.radius);
    const double gap = contact::nearest_gap(boundary, c.center, &name);
    if (gap >= r - kMostStartOverlap) continue;
    if (++bad <= 10)
      message += fmt::format(
          "{}: {} at ({:.4g}, {:.4g}, {:.4g}) um starts {:.3g} um inside {}; at most {} um is "
          "allowed.\n",
          scene.file, name_of(scene, c), c.center.x(), c.center.y(), c.center.z(), r - gap, name,
          kMostStartOverlap);
  }
  for (const auto& [i, j] : find_crowded(scene, cells)) {
    if (++bad > 10) continue;
    const PlacedCell &p = cells[i], &q = cells[j];
    message += fmt::format(
        "{}: {} and {} start {:.3g} um apart, centre to centre; at least half a radius, {:.3g} "
        "um, is needed.\n",
        scene.file, name_of(scene, p), name_of(scene, q), (p.center - q.center).norm(),
        0.5 * std::max(start_radius(scene, p.radius), start_radius(scene, q.radius)));
  }
  if (bad > 10) message += fmt::format("... and {} more.\n", bad - 10);
  check(bad == 0,
        message + (scene.start_up.enabled ? "Move these cells, or lower start_up.initial_radius."
                                          : "Move these cells, or start them small with the "
                                            "start_up block (acinus explain start_up.enabled)."));
}

double count_wanted_cells(const Scene& scene) {
  const CellsBlock& c = scene.cells;
  if (c.source == CellSource::kList) return static_cast<double>(c.list.size());
  if (c.source == CellSource::kBox) return 1.0 * c.grid[0] * c.grid[1] * c.grid[2];
  if (c.source == CellSource::kLobule && scene.lobule) return scene.lobule->cells;
  if (c.source == CellSource::kMeshes)
    return static_cast<double>(geometry::read_surfaces(c.file, c.unit).size());
  return c.count;
}

}  // namespace acinus::runs
