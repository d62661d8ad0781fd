#include "runs/assemble/build_substances.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

#include "core/box.hpp"
#include "core/error.hpp"
#include "core/parallel/memory.hpp"
#include "core/sphere.hpp"
#include "coupling/generate/domain.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/vessel_feed.hpp"
#include "coupling/world/cell.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "substances/planes.hpp"

namespace acinus::runs {
namespace {

/// Memory of the solver per voxel, measured with 3.4 million of them, and of a field with its
/// sources, bytes.
constexpr double kBytesPerVoxel = 130, kBytesPerFieldVoxel = 24;
/// More of them if a substance is kept out: its open space, and groups of voxels while they are
/// made.
constexpr double kBytesPerOpenVoxel = 230;
/// More of them for the graph of a substance behind membranes.
constexpr double kBytesPerGraphVoxel = 350;

int index_of(const Scene& scene, const std::string& substance) {
  const auto found = std::ranges::find(scene.substances, substance, &SubstanceBlock::name);
  return static_cast<int>(found - scene.substances.begin());
}

double smallest_radius(const Scene& scene) {
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& [name, type] : scene.cell_types) radius = std::min(radius, type.radius);
  return radius;
}

/// Box around cells, vessels and lobule. Walls along the axes end the margin.
Box find_box(const Scene& scene, const coupling::World& world) {
  if (scene.substance_grid.box)
    return {(*scene.substance_grid.box)[0], (*scene.substance_grid.box)[1]};
  const coupling::State& s = world.state;
  Box box;
  coupling::for_each_cell(s, [&](const coupling::Cell& c) {
    const double r = sphere_radius(coupling::volume_of(s, c).at(s.clock.time));
    const Box cell = sphere_box(coupling::center_of(s, c), r);
    box.include(cell.low);
    box.include(cell.high);
  });
  for (const Vec3& x : coupling::vessels_at_rest(world.params).node) box.include(x);
  if (scene.lobule) {
    const coupling::Domain domain = coupling::make_domain(lobule_parameters(scene));
    box.include(domain.low);
    box.include(domain.high);
  }
  box = box.grown(scene.substance_grid.margin);
  for (const contact::Plane& plane : world.params.boundary.planes)
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kAlong = 1 - 1e-9;
      const double along = plane.normal.normalized()[axis];
      if (along > kAlong) box.low[axis] = std::max(box.low[axis], plane.point[axis]);
      if (along < -kAlong) box.high[axis] = std::min(box.high[axis], plane.point[axis]);
    }
  return box;
}

void check_size(const Scene& scene, const Box& box, double spacing) {
  const double n = substances::count_voxels(box, spacing);
  const double needed = substance_memory(n, scene.substances), limit = machine_memory();
  constexpr double kMostVoxels = 1e9;
  check(needed <= limit && n <= kMostVoxels,
        fmt::format("{}: /substance_grid: {:.3g} voxels of {:.3g} um need {:.3g} GB of memory, and "
                    "this machine has {:.3g} GB. Take a larger /substance_grid/spacing, or a "
                    "smaller /substance_grid/box or margin.",
                    scene.file, n, spacing, 1e-9 * needed, 1e-9 * limit));
}

std::string name_grid(const substances::VoxelGrid& grid) {
  const Box box = grid.box();
  return fmt::format(
      "from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) um, in voxels of "
      "{:.3g} um",
      box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z(),
      grid.spacing.maxCoeff());
}

/// Adds a source to the voxels whose centres are in its region.
void add_source(const Scene& scene, const SourceEntry& source, const std::string& pointer,
                const substances::VoxelGrid& grid, substances::Medium& m) {
  std::size_t v = 0, inside = 0;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i, ++v) {
        if (!coupling::in_region(source.region, scene.axis_point, grid.center(i, j, k))) continue;
        ++inside;
        m.gain[v] += source.secretion;
        if (source.saturation > 0) m.loss[v] += source.secretion / source.saturation;
      }
  check(inside > 0,
        fmt::format("{}: {}/region holds the centre of no voxel, so the source would release "
                    "nothing. The fields reach {}. Move the source, or take a "
                    "/substance_grid/box that holds it, or a smaller /substance_grid/spacing if it "
                    "is smaller than a voxel.",
                    scene.file, pointer, name_grid(grid)));
}

void add_vessels(const Scene& scene, const SubstanceBlock& b, const std::string& pointer,
                 const coupling::World& world, substances::Medium& m) {
  const substances::VoxelGrid& grid = world.params.substances.grid;
  const bool kept_out = b.outside_cells() || b.outside_obstacles;
  std::vector<double>&gain = kept_out ? m.wall_gain : m.gain,
  &loss = kept_out ? m.wall_loss : m.loss;
  gain.resize(grid.n_voxel(), 0.0);
  loss.resize(grid.n_voxel(), 0.0);
  const double before = substances::sum_numbers(loss);
  coupling::add_vessel_feed(grid, coupling::vessels_at_rest(world.params), b.vessels->permeability,
                            b.vessels->concentration, gain, loss);
  check(substances::sum_numbers(loss) > before,
        fmt::format("{}: {}/vessels: no vessel is in the box of the fields, which reach {}. Take a "
                    "/substance_grid/box that holds vessels.",
                    scene.file, pointer, name_grid(grid)));
}

substances::Medium make_medium(const Scene& scene, const SubstanceBlock& b,
                               const coupling::World& world) {
  const substances::VoxelGrid& grid = world.params.substances.grid;
  const std::string pointer = fmt::format("/substances/{}", index_of(scene, b.name));
  substances::Medium m;
  m.diffusion = b.diffusion;
  m.decay = b.decay;
  m.face.fill(b.boundary);
  for (const FaceEntry& face : b.faces) m.face[static_cast<std::size_t>(face.side)] = face;
  if (b.sources.empty() && !b.vessels) return m;
  m.gain.assign(grid.n_voxel(), 0.0);
  m.loss.assign(grid.n_voxel(), 0.0);
  for (std::size_t k = 0; k < b.sources.size(); ++k)
    add_source(scene, b.sources[k], fmt::format("{}/sources/{}", pointer, k), grid, m);
  if (b.vessels) add_vessels(scene, b, pointer, world, m);
  return m;
}

coupling::Substance make_substance(const Scene& scene, const SubstanceBlock& b,
                                   const coupling::World& world) {
  coupling::Substance s;
  s.name = b.name;
  s.unit = b.unit;
  s.initial = b.initial;
  s.course = b.course;
  s.medium = make_medium(scene, b, world);
  s.outside_cells = b.outside_cells();
  s.permeability = b.permeability;
  s.outside_obstacles = b.outside_obstacles;
  for (const auto& [name, type] : scene.cell_types) {
    const auto found = std::ranges::find(type.exchange, b.name, &ExchangeEntry::substance);
    s.exchange.push_back(found == type.exchange.end() ? coupling::CellExchange{}
                                                      : coupling::CellExchange(*found));
  }
  return s;
}

void check_inside(const Scene& scene, const coupling::World& world) {
  const std::vector<std::int64_t> outside = find_cells_outside_fields(world);
  if (outside.empty()) return;
  constexpr std::size_t kMostNamed = 5;
  throw Error(fmt::format(
      "{}: /substance_grid/box: {} cells start outside the box of the fields (number {}{}). Give a "
      "box that holds all cells, up to the end of the run.",
      scene.file, outside.size(),
      fmt::join(std::span(outside).first(std::min(outside.size(), kMostNamed)), ", "),
      outside.size() > kMostNamed ? ", ..." : ""));
}

}  // namespace

double substance_memory(double n_voxel, const std::vector<SubstanceBlock>& substances) {
  const bool kept_out = std::ranges::any_of(
      substances, [](const SubstanceBlock& s) { return s.outside_cells() || s.outside_obstacles; });
  const bool has_membranes = std::ranges::any_of(
      substances, [](const SubstanceBlock& s) { return s.cells == CellPassage::kMembrane; });
  return n_voxel * (kBytesPerVoxel + (kept_out ? kBytesPerOpenVoxel : 0) +
                    (has_membranes ? kBytesPerGraphVoxel : 0) +
                    kBytesPerFieldVoxel * static_cast<double>(substances.size()));
}

std::vector<std::int64_t> find_cells_outside_fields(const coupling::World& world) {
  std::vector<std::int64_t> outside;
  if (!world.params.substances.exists()) return outside;
  const Box box = world.params.substances.grid.box();
  coupling::for_each_cell(world.state, [&](const coupling::Cell& c) {
    if (!box.contains(coupling::center_of(world.state, c)))
      outside.push_back(coupling::lineage_of(world.state, c));
  });
  return outside;
}

void build_substances(const Scene& scene, coupling::World& world, Notes& notes) {
  if (scene.substances.empty()) return;
  coupling::SubstanceParams& p = world.params.substances;
  const SubstanceGridBlock& g = scene.substance_grid;
  const Box box = find_box(scene, world);
  const double spacing = g.spacing > 0 ? g.spacing : smallest_radius(scene);
  check_size(scene, box, spacing);
  p.grid = substances::make_grid(box, spacing);
  p.first_grid = p.grid;
  p.grows = g.grow;
  p.margin = g.margin;
  p.longest_step = g.step;
  p.tolerance = g.tolerance;
  p.leader_signal =
      scene.motility.leader_signal.empty() ? -1 : index_of(scene, scene.motility.leader_signal);
  for (const SubstanceBlock& b : scene.substances)
    p.substance.push_back(make_substance(scene, b, world));
  check_inside(scene, world);
  coupling::begin_substances(p, world.state);
  coupling::begin_open_spaces(world);
  notes.info.push_back(fmt::format(
      "substances ({}): {} x {} x {} = {} voxels of {:.3g} x {:.3g} x {:.3g} um from ({:.4g}, "
      "{:.4g}, {:.4g}) um, {:.2g} GB",
      fmt::join(scene.substances | std::views::transform(&SubstanceBlock::name), ", "), p.grid.n[0],
      p.grid.n[1], p.grid.n[2], p.grid.n_voxel(), p.grid.spacing.x(), p.grid.spacing.y(),
      p.grid.spacing.z(), p.grid.low.x(), p.grid.low.y(), p.grid.low.z(),
      1e-9 * substance_memory(static_cast<double>(p.grid.n_voxel()), scene.substances)));
}

}  // namespace acinus::runs
