#include "runs/calibrate/compression_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "runs/assemble/place_cells.hpp"
#include "runs/experiments/capsule_experiment.hpp"
#include "runs/experiments/pull_off_experiment.hpp"
#include "runs/scene/writer.hpp"

namespace acinus::runs {
namespace {

/// Ratio of the capsule volume at an overlap d = 0.2 of neighbours to the volume of the free cells,
/// measured with 15 cells.
constexpr double kCompressedVolume = 0.70;
/// Shrink rate relative to the smallest radius, 1/s: 0.3 um/h at 26 um. Halving it changes the
/// force by 1 % (docs/science/calibration.md).
constexpr double kShrinkRate = 0.0115 / 3600;
/// Least ratio of the local area modulus to the bulk modulus, um; softer surfaces fold under this
/// pressure.
constexpr double kLeastLocalAreaModulus = 0.04;

/// Largest distance of a cell's centre from the origin, um.
double reach_of(const Scene& scene) {
  double reach = 0;
  for (const PlacedCell& c : place_cells(scene, nullptr, {}, {}))
    reach = std::max(reach, c.center.norm());
  return reach;
}

/// Scene of the same cell type and contact without clump and capsule, for cells of a list.
Scene without_clump(const Scene& compression) {
  Scene s = compression;
  s.experiment = Experiment::kFree;
  s.capsule = {};
  s.cells.source = CellSource::kList;
  s.cells.list.clear();
  return s;
}

}  // namespace

std::string choose_type(const Scene& scene, const std::string& type) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : scene.cell_types) names.push_back(name);
  check(type.empty() || scene.cell_types.contains(type),
        fmt::format("--type {}: no such cell type in {}; there is {}", type, scene.file,
                    fmt::join(names, ", ")));
  check(!type.empty() || names.size() == 1,
        fmt::format("{} has the cell types {}: say which with --type", scene.file,
                    fmt::join(names, ", ")));
  return type.empty() ? names.front() : type;
}

Scene compression_scene(const Scene& scene, const ClumpOptions& options) {
  const bool itself = is_capsule_compression(scene);
  Scene s = scene;
  if (!itself) {
    s = Scene{};
    s.file = scene.file;
    s.seed = scene.seed;
    s.contact = scene.contact;
    s.friction = scene.friction;
    s.numerics.cg = scene.numerics.cg;
    s.experiment = Experiment::kCapsule;
    s.numerics.max_step = 60;
    s.numerics.tolerance = 0.1;
    s.numerics.extrapolate = true;
    s.motility.random = false;
    s.cells.source = CellSource::kClump;
    s.cells.lattice = coupling::Lattice::kBcc;
    s.cells.count = 59;  // fewer, and the neighbours of the central cell stand at the wall
    s.cells.jitter = 0.01;
    s.output.every = 1200;
  }
  const std::string name = choose_type(scene, options.type);
  CellType type = scene.cell_types.at(name);
  type.cycle = {};  // else they would start at a random age, with its size
  type.diffusion = 0;
  type.dcm.local_area_modulus =
      std::max(type.dcm.local_area_modulus, kLeastLocalAreaModulus * type.dcm.bulk_modulus);
  type.dcm.nucleus.reset();  // spheres have neither
  type.dcm.contraction.reset();
  type.exchange.clear();
  type.cbm.young_spread = 0;
  type.cbm.stiffness_correction = "none";
  s.cell_types = {{name, type}};
  s.cells.types.clear();
  s.life = {};
  s.substances.clear();
  s.substance_grid = {};
  s.rules.clear();
  s.motility.leader_signal.clear();
  s.name = "calibration";
  s.model = s.cells.model = CellModel::kDcm;
  if (options.cells > 0) s.cells.count = options.cells;
  if (!itself || options.cells > 0) {
    s.capsule = CapsuleEntry{};
    s.capsule.enabled = true;
    s.capsule.radius = reach_of(s) + 1.1 * type.radius;
    s.capsule.min_radius = type.radius * std::cbrt(s.cells.count * kCompressedVolume);
    s.capsule.speed = kShrinkRate * s.capsule.min_radius;
    s.time.end = (s.capsule.radius - s.capsule.min_radius) / s.capsule.speed;
  }
  if (options.rate != 1) {
    s.capsule.speed *= options.rate;
    s.time.end /= options.rate;
    s.output.every /= options.rate;
  }
  set_canonical(s);
  return s;
}

Scene pair_scene(const Scene& compression) {
  constexpr double kNearlyTouching = 0.995;  // of a radius from the plane between them
  constexpr double kTimeToRest = 6 * 3600;   // s; the overlap is within 0.3 % after a third of it
  Scene s = without_clump(compression);
  for (const int side : {-1, 1}) {
    CellEntry cell;
    cell.position = {side * kNearlyTouching * s.cell_types.begin()->second.radius, 0, 0};
    s.cells.list.push_back(cell);
  }
  s.time.end = kTimeToRest;
  s.output.every = kTimeToRest;
  set_canonical(s);
  return s;
}

Scene pull_scene(const Scene& compression, std::uint64_t seed) {
  constexpr double kAdhere = 150, kEnd = 2000, kEvery = 10, kStep = 2;  // s
  constexpr double kMostForce = 6;                                      // in pi W R^
  Scene s = pair_scene(compression);
  s.experiment = Experiment::kPullOff;
  s.seed = seed;
  s.friction.liquid = true;
  s.friction.viscosity = FrictionBlock{}.viscosity;
  s.contact.cell_friction = 0;
  s.numerics.adaptive = false;
  s.numerics.extrapolate = false;
  s.numerics.max_step = kStep;
  s.time.end = kEnd;
  s.output.every = kEvery;
  for (CellEntry& cell : s.cells.list) cell.random_orientation = true;
  for (const int cell : {0, 1}) {
    PullEntry pull;
    pull.cell = cell;
    pull.direction = Vec3(cell == 0 ? -1 : 1, 0, 0);
    pull.force.entry = {{kAdhere, 0}, {kEnd, kMostForce * vesicle_pull_off(pair_of(s))}};
    s.pulls.push_back(pull);
  }
  set_canonical(s);
  return s;
}

Scene sliding_scene(const Scene& compression) {
  constexpr int kAlong = 4, kAcross = 3;
  // Hexagonal layers at the distances of cells that adhere, over the radius.
  constexpr double kSpacing = 1.79, kHeight = 3.08;
  constexpr double kPull = 2e-3;         // kPa, force of a cell over its squared radius
  constexpr double kUsualFriction = 50;  // nN s/um^3, with which the times below go
  constexpr double kEnd = 6 * 3600, kEvery = 1800, kStep = 60;  // s
  Scene s = without_clump(compression);
  CellType& type = s.cell_types.begin()->second;
  type.cbm.medium_friction = type.dcm.medium_friction;
  s.friction.cbm_cbm.reset();
  s.friction.cbm_vessel = s.friction.dcm_vessel;
  s.start_up = {};
  s.start_up.enabled = true;
  const double spacing = kSpacing * type.radius, row = spacing * std::sqrt(3) / 2;
  for (const int side : {-1, 1})
    for (int j = 0; j < kAcross; ++j)
      for (int i = 0; i < kAlong; ++i) {
        CellEntry cell;
        const double shift = 0.5 * (j % 2) + (side > 0 ? 0.5 : 0);
        cell.position = {(i + shift) * spacing, (j + (side > 0 ? 1.0 / 3 : 0)) * row,
                         side * kHeight / 4 * type.radius};
        cell.pull = {side * kPull * type.radius * type.radius, 0, 0};
        s.cells.list.push_back(cell);
      }
  s.walls.clear();
  for (const int side : {-1, 1}) {
    WallEntry wall;
    wall.mirror = true;
    wall.name = side < 0 ? "lower" : "upper";
    wall.point = {0, 0, side * kHeight / 2 * type.radius};
    wall.normal = {0, 0, static_cast<double>(-side)};
    s.walls.push_back(wall);
  }
  const double slower = s.contact.cell_friction / kUsualFriction;
  s.time.end = slower * kEnd;
  s.output.every = slower * kEvery;
  s.numerics.max_step = slower * kStep;
  set_canonical(s);
  return s;
}

Scene as_spheres(const Scene& compression, const std::string& law_file) {
  Scene s = compression;
  s.model = s.cells.model = CellModel::kCbm;
  for (auto& [name, type] : s.cell_types) type.cbm.stiffness_correction = law_file;
  set_canonical(s);
  return s;
}

}  // namespace acinus::runs
