#include "runs/assemble/build_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "coupling/generate/lobule.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/life/cell_cycle.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/start_shapes.hpp"
#include "coupling/start_up.hpp"
#include "coupling/take_shapes.hpp"
#include "coupling/world/orientation.hpp"
#include "geometry/measures.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/assemble/build_correction.hpp"
#include "runs/assemble/build_life.hpp"
#include "runs/assemble/build_params.hpp"
#include "runs/assemble/build_rules.hpp"
#include "runs/assemble/build_substances.hpp"
#include "runs/assemble/cell_types.hpp"
#include "runs/assemble/place_cells.hpp"
#include "runs/assemble/placing_advice.hpp"
#include "runs/assemble/start_state.hpp"

namespace acinus::runs {
namespace {

/// Creates the state of deformable cells and spheres along a space-filling curve. Meshes get a
/// uniformly distributed random orientation unless the cell fixes it.
void add_cells(const Scene& scene, const std::vector<PlacedCell>& cells,
               const std::vector<std::string>& types, const coupling::Params& params,
               coupling::State& state) {
  std::vector<Vec3> centers;
  for (const PlacedCell& c : cells) centers.push_back(c.center);
  std::vector<dcm::NewCell> shells;
  std::vector<cbm::NewCell> spheres;
  for (int k : coupling::space_filling_order(centers)) {
    const PlacedCell& c = cells[k];
    const CellType& t = scene.cell_types.at(c.type);
    const int type = static_cast<int>(std::ranges::find(types, c.type) - types.begin());
    if (c.deformable) {
      shells.push_back(
          {c.lineage, type, &geometry::shared_icosphere(t.dcm.nodes), c.center, c.radius, c.pull,
           c.oriented ? Mat3(Mat3::Identity())
                      : coupling::random_orientation(scene.seed, c.lineage),
           dcm::nucleus_mesh(params.dcm[type].nucleus ? &*params.dcm[type].nucleus : nullptr)});
    } else {
      const double young = cbm::draw_young(params.cbm[type], scene.seed, c.lineage);
      spheres.push_back({c.lineage, type, c.center, c.radius, young, c.pull});
    }
  }
  state.dcm = dcm::make_state(shells);
  state.cbm = cbm::make_state(spheres);
  state.next_lineage = static_cast<std::int64_t>(cells.size());
}

/// Generates the lobule of the scene. Notes give its packing, and warn if it has fewer cells than
/// asked for.
/// @pre the scene has a lobule
coupling::Lobule build_lobule(const Scene& scene, Notes& notes) {
  const LobuleBlock& b = *scene.lobule;
  coupling::Lobule lobule = draw_lobule(scene);
  if (static_cast<int>(lobule.seeds.size()) < b.cells)
    notes.warnings.push_back(
        fmt::format("space for {} of the {} cells asked for", lobule.seeds.size(), b.cells));
  double cells = 0;
  for (std::size_t k = 0; k < lobule.seeds.size(); ++k)
    cells += sphere_volume(
        scene.cell_types.at(draw_cell_type(scene, static_cast<std::int64_t>(k), lobule.seeds[k]))
            .radius);
  const double lesion = b.shape == coupling::LobuleShape::kPie
                            ? kPi * b.lesion_radius * b.lesion_radius / 6
                            : kPi * b.lesion_radius * b.lesion_radius;
  notes.info.push_back(
      fmt::format("lobule {}: height {} um, {} cells at least {} um apart fill {:.2f} of the "
                  "volume outside the lesion",
                  name_of_choice(b.shape), b.height, lobule.seeds.size(), b.min_distance,
                  cells / (lobule.volume - lesion * b.height)));
  return lobule;
}

/// Warns of adhesion too strong for the cortex: cells spread over each other until faces fold and
/// cross. Of 382 random scenes with W from 0.005 to 26 E h, 13 of the 14 with self-intersecting
/// cells had W above 0.7 E h (docs/developers/verification.md).
void note_weak_cortex(const Scene& scene, const dcm::State& cells, Notes& notes) {
  constexpr double kMostAdhesionOverStretch = 0.5;  // E h
  const auto empty = std::ranges::count(cells.lineage, dcm::kEmptyLane);
  if (std::ssize(cells.lineage) - empty < 2) return;
  int index = 0;
  for (const auto& [name, type] : scene.cell_types) {
    const double stretch = type.dcm.cortex_young * type.dcm.cortex_thickness;
    const bool has_cells = std::ranges::any_of(
        cells.group, [index](const dcm::Group& group) { return group.type == index; });
    ++index;
    if (!has_cells || type.adhesion <= kMostAdhesionOverStretch * stretch) continue;
    notes.warnings.push_back(fmt::format(
        "cell_types.{}.adhesion is {:.2g} J/m^2, {:.2g} times cortex_young x cortex_thickness, "
        "what "
        "holds the cortex together: deformable cells will spread over each other until they fold, "
        "and may intersect themselves. Below {} times ({:.2g} J/m^2) they do not.",
        name, 1e-3 * type.adhesion, type.adhesion / stretch, kMostAdhesionOverStretch,
        1e-3 * kMostAdhesionOverStretch * stretch));
  }
}

/// Warns of cells of a size that no animal tissue has: a mistyped unit.
void note_unusual_radius(const Scene& scene, Notes& notes) {
  constexpr double kLeast = 1, kMost = 100;  // um
  for (const auto& [name, type] : scene.cell_types)
    if (type.radius < kLeast || type.radius > kMost)
      notes.warnings.push_back(fmt::format(
          "cell_types.{}.radius is {:.3g} um; cells of animal tissue have {} to {} um. Is the unit "
          "right?",
          name, type.radius, kLeast, kMost));
}

/// Notes rules and rates of life that begin at the end of the scene or later.
void note_late_rules(const Scene& scene, Notes& notes) {
  const auto note = [&](const std::string& what, double from) {
    if (from < scene.time.end) return;
    notes.info.push_back(
        fmt::format("{} never acts: it begins at {:.4g} h, and the scene ends at {:.4g} h", what,
                    from / 3600, scene.time.end / 3600));
  };
  for (std::size_t k = 0; k < scene.life.rules.size(); ++k)
    note(fmt::format("life.rules.{}", k), scene.life.rules[k].from);
  if (!scene.life.proliferation) return;
  for (std::size_t k = 0; k < scene.life.proliferation->rate.size(); ++k)
    note(fmt::format("life.proliferation.rates.{}", k), scene.life.proliferation->rate[k].from);
}

/// Warns of leaders that are pulled toward an axis without a vein. The axis is where axis_point has
/// it in every scene, so the force acts all the same.
void note_leaders_without_vein(const Scene& scene, Notes& notes) {
  const MotilityBlock& m = scene.motility;
  if (m.leader_force <= 0 || !m.leader_signal.empty()) return;
  if (scene.lobule || !scene.vessels.file.empty()) return;
  notes.warnings.push_back(
      fmt::format("motility.leader_force pulls the leading cells toward the vertical axis through "
                  "axis_point = ({:.4g}, {:.4g}) um, where this scene has no vein. A lobule block "
                  "or vessels.file has one; motility.leader_signal follows a substance instead.",
                  scene.axis_point[0], scene.axis_point[1]));
}

void note_cut_cells(const Scene& scene, const coupling::CutCells& cut, double depth, Notes& notes) {
  if (cut.cells.empty()) return;
  constexpr std::size_t kMostNamed = 5;
  const bool more = cut.cells.size() > kMostNamed;
  std::vector<std::string> ways = list_smaller_starts(scene);
  ways.push_back(advise_spacing(scene));
  notes.warnings.push_back(fmt::format(
      "the scene starts with overlaps: {} deformable cells (number {}{}) stand more than {:.3g} um "
      "deep in others. Each was cut where it meets them, down to {:.2g} of its volume, and starts "
      "under the pressure of that. {}.",
      cut.cells.size(),
      fmt::join(std::span(cut.cells).first(more ? kMostNamed : cut.cells.size()), ", "),
      more ? ", ..." : "", depth, cut.smallest_volume, fmt::join(ways, ", or ")));
}

/// Deforms cell k to the shape of surface k; cells whose mesh cannot follow stay spherical, with a
/// warning.
void give_shapes(const std::vector<geometry::Surface>& surfaces, coupling::World& world,
                 Notes& notes) {
  std::vector<coupling::CellSurface> shape;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    shape.push_back({static_cast<std::int64_t>(k), &surfaces[k]});
  const coupling::TakenShapes taken = coupling::take_shapes(shape, world);
  if (taken.laid + taken.inflated > 0)
    notes.info.push_back(fmt::format(
        "{} cells have the shape of their surface{}; worst triangle {:.2f} of 1",
        taken.laid + taken.inflated,
        taken.inflated > 0 ? fmt::format(", {} of them blown up inside it", taken.inflated)
                           : std::string(),
        taken.worst_quality));
  for (const auto& [lineage, cause] : taken.round)
    notes.warnings.push_back(fmt::format(
        "cell {} starts as a ball of its volume, not in its shape: {}. A finer mesh may follow it "
        "(dcm.nodes of its type).",
        lineage, cause));
}

}  // namespace

BuiltWorld build_world(const Scene& scene, const Ranks& ranks) {
  BuiltWorld built;
  coupling::World& world = built.world;
  coupling::Params& p = world.params;
  world.ranks = ranks;

  std::optional<coupling::Lobule> lobule;
  if (scene.lobule) lobule = build_lobule(scene, built.notes);
  add_boundary(scene, lobule ? &*lobule : nullptr, p.boundary, built.notes);
  built.vessel_length = geometry::total_length(p.boundary.vessels.network);
  p.tree = build_tree(scene, p.boundary.vessels.network);
  check(
      !p.tree.exists() || ranks.is_alone(),
      "vessels that are flexible are worked out by one process only: start without mpirun, or set "
      "vessels.flexible to false");

  for (const auto& [name, type] : scene.cell_types) {
    built.type_names.push_back(name);
    p.dcm.push_back(make_dcm_params(scene, type));
    p.cbm.push_back(make_cbm_params(scene, type));
  }
  build_corrections(scene, p.cbm, built.notes);
  build_life(scene, p, built.type_names);
  p.rules = build_rules(scene, p.life, built.notes);
  note_late_rules(scene, built.notes);
  note_leaders_without_vein(scene, built.notes);
  set_params(scene, p);
  world.state.tree = coupling::at_rest(p.tree);
  coupling::place_vessels(p.tree, world.state.tree, p.boundary.vessels);
  if (!scene.start_up.from.empty()) {
    built.notes.info.push_back(take_start(scene, types_of(p), world.state));
    coupling::place_vessels(p.tree, world.state.tree, p.boundary.vessels);
    coupling::begin_life(world);
    build_substances(scene, world, built.notes);
    return built;
  }
  const std::vector<geometry::Surface> surfaces = read_cell_surfaces(scene);
  std::vector<PlacedCell> cells =
      place_cells(scene, lobule ? &*lobule : nullptr, surfaces, p.boundary);
  for (PlacedCell& c : cells) {  // older cells are larger
    if (c.shaped) continue;
    const std::size_t type = std::distance(scene.cell_types.begin(), scene.cell_types.find(c.type));
    c.radius *= std::cbrt(1 + coupling::draw_start_age(p.life.type[type], scene.seed, c.lineage));
  }
  check_starts(scene, cells, p.boundary);
  add_cells(scene, cells, built.type_names, p, world.state);
  note_weak_cortex(scene, world.state.dcm, built.notes);
  note_unusual_radius(scene, built.notes);
  build_substances(scene, world, built.notes);
  if (scene.start_up.enabled) {
    coupling::begin_start_up(world, scene.start_up.initial_radius);
  } else if (!surfaces.empty()) {
    give_shapes(surfaces, world, built.notes);
    coupling::begin_life(world);
  } else {
    note_cut_cells(scene, coupling::cut_overlapping(world), p.dcm_contact.max_depth, built.notes);
    coupling::begin_life(world);
  }
  return built;
}

}  // namespace acinus::runs
