#pragma once
/// Scene after reading: every default filled in, every quantity in base units (um, s, nN).
/// Plain data. Blocks are the types that the models use, with what else their keys say. A key's
/// default is its initialiser in the model's type or, where no model has it, here; the registry
/// (registry.hpp) reads it from there and adds path, unit, range, meaning and effects. Constants
/// that assemble/ derives from other keys are 0 where that is left to it ("auto").

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cbm/params.hpp"
#include "contact/boundary.hpp"
#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "coupling/apparatus/pull/pull.hpp"
#include "coupling/apparatus/stretcher/stretcher.hpp"
#include "coupling/apparatus/temperature/temperature.hpp"
#include "coupling/generate/domain.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/vessels/vessel_tree.hpp"
#include "coupling/world/world.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/scene/choices.hpp"
#include "runs/scene/substance_blocks.hpp"

namespace acinus::runs {

struct TimeBlock {
  double end = 0;       ///< s after t = 0
  int until_cells = 0;  ///< the run ends when there are so many cells; 0 = no such end
};

struct StartUpBlock : coupling::StartUp {
  double initial_radius = coupling::LobuleParameters{}.initial_radius;  ///< um
  std::string from;  ///< run folder whose state at t = 0 is taken; empty = none
};

/// Active tension over time and over the surface.
struct ContractionBlock : dcm::ContractileRing {
  Schedule course;  ///< factor over s since t = 0; empty: 1
};

/// Deformable cell parameters of a cell type (Table 1). Left to assemble/: the stiffness of springs
/// and hinges, the constants of both models in CellType, and friction with vessels.
struct DcmBlock : dcm::Params {
  int nodes = 162;
  double cortex_young = dcm::kCortexYoung;  ///< kPa
  double cortex_poisson = dcm::kCortexPoisson;
  std::optional<ContractionBlock> contraction;  ///< of cortex_tension; empty: constant and uniform
};

/// Centre-based parameters of a cell type (Table 1). young = 0: 3 K_V (1 - 2 nu).
struct CbmBlock : cbm::Params {
  std::string stiffness_correction = "none";  ///< law file | none | auto (calibrate here) | paper
  bool single_overlaps =
      cbm::StiffnessLaw{}.single_overlaps;  ///< a single deep neighbour stiffens the sphere
  CbmBlock() { young = 0; }
};

/// Adhesion energy with another cell type, in place of the geometric mean.
struct PairAdhesion {
  std::string type;
  double adhesion = 0;  ///< nN/um (mJ/m^2)
};

struct CellType {
  double radius = 12;                          ///< um at rest
  double adhesion = dcm::Params{}.adhesion;    ///< nN/um (mJ/m^2), pair value = sqrt(Wa Wb)
  std::vector<PairAdhesion> adhesion_with;     ///< given at one of the two types
  double diffusion = dcm::Params{}.diffusion;  ///< um^2/s, motility D
  coupling::CycleParams cycle;
  double softening = 1;  ///< lysis: factor on cortex_young, bulk_modulus and adhesion meanwhile
  std::vector<ExchangeEntry> exchange;  ///< with substances
  DcmBlock dcm;
  CbmBlock cbm;
};

/// Contact of surfaces. range_factor = 0: 0.3 (3-point), 0.5 (nodes), 0.35 (both).
struct ContactBlock : dcm::ContactParams {
  ContactBlock() { range_factor = 0; }
};

struct FrictionBlock {            ///< friction but that between deformable cells, see ContactBlock
  std::optional<double> cbm_cbm;  ///< nN s/um^3; empty = by the law, else cbm::Params
  std::optional<double> dcm_cbm;  ///< empty = harmonic mean of the two
  std::optional<double> dcm_vessel;  ///< empty = the type's dcm ecm_friction
  std::optional<double> cbm_vessel;  ///< empty = the type's cbm ecm_friction
  bool liquid = false;               ///< Stokes drag instead of friction per area
  double viscosity = 1e-6;           ///< nN s/um^2 (1e-3 Pa s)
};

/// Active forces. leader_slice = 0: the cell diameter.
struct MotilityBlock : coupling::Motility {
  std::string leader_signal;  ///< substance whose gradient leaders follow; empty: the vein axis
  MotilityBlock() { leader_slice = 0; }
};

using coupling::Region;
using coupling::RegionKind;

/// Rule by which cells rest or die, for cells that `region` and `cells` both accept.
struct LifeRuleBlock : coupling::LifeRule {
  std::optional<Region> region;  ///< cells with their centre in it; empty = anywhere
};

/// Rates at which resting cells enter the cycle, by their layer from the edge of the lesion.
/// thickness = 0: the cell diameter.
struct ProliferationBlock : coupling::Proliferation {
  ProliferationBlock() { thickness = 0; }
};

struct LifeBlock {
  std::vector<LifeRuleBlock> rules;
  std::optional<ProliferationBlock> proliferation;
  double grid =
      coupling::LifeParams{}.grid;  ///< s between checks of rules, inhibition, sleep, mesh
  bool sleep =
      coupling::Sleep{}.enabled;  ///< cells in balance are left out of the step until pushed
  double sleep_traction =
      coupling::Sleep{}.traction;  ///< kPa out of balance, below which a cell falls asleep
  bool remesh = coupling::LifeParams{}.remesh;  ///< degenerate meshes of cells are mended
};

/// Zoom that follows the tissue.
struct MovingZoomBlock : coupling::ZoomParams {
  MovingZoomBlock() { grid = 1800; }
};

struct CellEntry {
  Vec3 position = Vec3::Zero();     ///< um
  std::string type;                 ///< empty = the only type
  std::optional<double> radius;     ///< um
  std::optional<CellModel> model;   ///< not kZoom; overrides model and zoom
  bool random_orientation = false;  ///< of the mesh of a deformable cell
  Vec3 pull = Vec3::Zero();         ///< nN, constant force spread over the cell
};

/// Cell type of generated cells, with its share.
struct TypeShare {
  std::string type;
  double share = 1;              ///< weight against the other types for the same place
  std::optional<Region> region;  ///< cells with their centre in it; empty = all in no region
};

struct CellsBlock {
  CellSource source = CellSource::kList;
  std::optional<CellModel> model;  ///< empty = deformable, by the zoom regions if there are any
  std::vector<CellEntry> list;
  std::vector<TypeShare> types;                   ///< of generated cells; empty = the only type
  int count = coupling::ClumpParameters{}.count;  ///< clump: cells kept, nearest the centre first
  coupling::Lattice lattice = coupling::ClumpParameters{}.lattice;  ///< clump
  double spacing = 1.0;  ///< clump, box: centre distance in cell diameters
  double jitter = 0.0;   ///< clump, box: random displacement in cell diameters
  std::array<int, 3> grid = coupling::BoxParameters{}.count;  ///< box: cells along x, y, z
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();               ///< fill: corners of the box, um
  double min_distance = 20;  ///< fill: smallest centre distance, um
  std::string file;          ///< meshes: closed surfaces, one a cell
  double unit = 1;           ///< meshes: um per unit of the file
};

/// Generated lobule. Left to assemble/: initial_radius.
struct LobuleBlock : coupling::LobuleParameters {};

/// Vessels and what they are made of.
struct VesselBlock : coupling::TubeMaterial {
  std::string
      file;  ///< empty = none, or generated by the lobule; resolved against the scene's folder
  std::string radius_array;   ///< of a VTK file; empty = one of the usual names
  double unit = 1;            ///< um per file unit
  double scale = 1;           ///< factor on positions and radii
  double radius_scale = 1;    ///< further factor on radii
  Vec3 shift = Vec3::Zero();  ///< um, after scaling
  bool center = false;  ///< move the network's bounding box centre to the origin before the shift
  std::optional<std::array<Vec3, 2>> crop;  ///< keep segments with a part inside this box, um
  double adhesion = contact::kVesselMaterial.adhesion;  ///< nN/um
  VesselWalls contact = VesselWalls::kCones;
  bool flexible = false;  ///< cells bend them
  coupling::VesselAnchors anchors = coupling::VesselAnchors::kEnds;
  std::optional<double> spacing;  ///< um, longest segment of flexible vessels; empty = as they are
};

struct WallEntry {  ///< plane; cells stay where (x - point).normal >= 0
  std::string name;
  Vec3 point = contact::Plane{}.point, normal = contact::Plane{}.normal;
  double speed = contact::Plane{}.speed;    ///< um/s along the normal (a moving wall), from t = 0
  double travel = contact::Plane{}.travel;  ///< um, where the motion stops
  /// Stands for equal cells on the other side: no adhesion, no friction.
  bool mirror = contact::Plane{}.material.mirror;
  double adhesion = contact::Plane{}.material.adhesion;  ///< nN/um, cell and wall, not mirror
  std::optional<double> opens;  ///< s after t = 0, after which it is gone; empty = never
  std::optional<double> young;  ///< kPa, what spheres feel, not mirror; empty = rigid
  double poisson = contact::Plane{}.material.poisson;  ///< not mirror
};

struct CapsuleEntry {  ///< rigid sphere seen from inside
  bool enabled = false;
  Vec3 center = contact::Capsule{}.center;
  double radius = contact::Capsule{}.radius;
  double speed = contact::Capsule{}.speed;  ///< um/s, shrink rate from t = 0
  double min_radius = contact::Capsule{}.min_radius;
  std::optional<double> opens;  ///< s after t = 0, after which it is gone; empty = never
};

struct StaticMeshEntry {
  std::string name, file;
  double unit = 1;  ///< um per file unit
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  bool inside = false;  ///< true: cells live inside it (normals are flipped)
};

/// Rigid tube, its axis of any length > 0. Left to assemble/: name, material.
struct PipetteBlock : contact::Pipette {
  Schedule suction;  ///< kPa
};

/// Force on a single cell over time, or spring that holds it. The direction may have any length
/// > 0; assemble/ computes the anchor.
struct PullEntry : coupling::Pull {
  PullBy by = PullBy::kForce;
};

struct OutputBlock {
  double every = 1800;  ///< s
  /// Number of further frames after a wall or the capsule opens, for every factor ten of the time
  /// since, from 1 s on; 0 = none.
  int after_opening = 0;
  bool compress = true;   ///< the run file
  bool start_up = false;  ///< also write frames at t < 0
  bool contacts = false;  ///< also write the contacts of every pair
};

struct Scene {
  std::string file;  ///< path it was read from
  std::string name;
  std::string description;
  std::uint64_t seed = coupling::LifeParams{}.seed;
  Experiment experiment = Experiment::kFree;
  std::optional<CellModel> model;  ///< replaces cells.model; empty = cells.model stays
  Accuracy accuracy = Accuracy::kByKey;
  TimeBlock time;
  coupling::Numerics numerics;
  StartUpBlock start_up;
  std::map<std::string, CellType> cell_types;
  CellsBlock cells;
  LifeBlock life;
  std::vector<SubstanceBlock> substances;
  SubstanceGridBlock substance_grid;
  std::vector<SignalRuleEntry> rules;
  std::vector<Region> zoom;  ///< union of regions
  std::optional<MovingZoomBlock> moving_zoom;
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical (z) through this point
  ContactBlock contact;
  FrictionBlock friction;
  MotilityBlock motility;
  std::optional<LobuleBlock> lobule;
  VesselBlock vessels;
  std::vector<WallEntry> walls;
  CapsuleEntry capsule;
  std::vector<StaticMeshEntry> static_meshes;
  std::optional<PipetteBlock> pipette;
  std::optional<coupling::Stretcher> stretcher;
  std::optional<coupling::Temperature> temperature;
  std::vector<PullEntry> pulls;
  OutputBlock output;

  std::string
      resolved_json;        ///< every key with its value, canonical order, as written to provenance
  std::string hash;         ///< hash of resolved_json
  std::string start_state;  ///< hash of the state in start_up.from; "" = none
};

/// Model of the cells without one of their own.
inline CellModel model_of(const Scene& scene) {
  const CellModel by_regions = scene.zoom.empty() ? CellModel::kDcm : CellModel::kZoom;
  return scene.model.value_or(scene.cells.model.value_or(by_regions));
}

/// Adhesion energy between two types of the scene, nN/um: that given for the pair, else the
/// geometric mean.
inline double pair_adhesion(const Scene& scene, const CellType& a, const CellType& b) {
  const auto given = [&scene](const CellType& one, const CellType& other) -> const double* {
    for (const PairAdhesion& pair : one.adhesion_with)
      if (const auto found = scene.cell_types.find(pair.type);
          found != scene.cell_types.end() && &found->second == &other)
        return &pair.adhesion;
    return nullptr;
  };
  if (const double* by_a = given(a, b)) return *by_a;
  if (const double* by_b = given(b, a)) return *by_b;
  return std::sqrt(a.adhesion * b.adhesion);
}

}  // namespace acinus::runs
