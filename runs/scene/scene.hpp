#pragma once
/// A scene after reading: every default filled in, every quantity in base units (um, s, nN).
/// Plain data. A key's default is its initialiser here and nowhere else; the registry
/// (registry.hpp) reads it from here and adds path, unit, range and meaning.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace acinus::runs {

struct TimeBlock {
  double end = 0;           ///< s after t = 0
  double step = 60;         ///< s, the longest step
  double min_step = 1e-5;   ///< s
  bool adaptive = true;     ///< step-size controller on
  double tolerance = 0.01;  ///< um, error a step may make (controller)
  double max_move = 0.3;    ///< displacement cap, in mean edge lengths; 0 = no cap
  std::string integrator = "linearly-implicit";
  bool with_contacts = false;  ///< ros2 although cells may touch
  bool extrapolate = false;    ///< linearise where the last step's velocity leads
  int until_cells = 0;         ///< the run ends when there are so many cells; 0 = no such end
};

struct SolverBlock {
  double tolerance = 3e-3;  ///< CG, relative to the right-hand side
  int max_iterations = 2000;
};

struct StartUpBlock {
  bool enabled = false;
  double initial_radius = 3;                ///< um
  double growth_time = 3600;                ///< s
  double adhesion_ramp = 900;               ///< s
  double max_duration = 3 * 3600;           ///< s, cap on the settling after growth
  double speed_tolerance = 0.01 / 60;       ///< um/s
  double pressure_tolerance = 0.01 / 3600;  ///< 1/s, relative pressure change
  std::string from;  ///< run folder whose state at t = 0 is taken; empty = none
};

struct DcmBlock {  ///< deformable cell parameters of a cell type (Table 1)
  int nodes = 162;
  double cortex_young = 1.0;      ///< kPa
  double cortex_thickness = 0.5;  ///< um
  double cortex_poisson = 0.5;
  double area_modulus = 0.8;                      ///< nN/um, K_A, global term
  double local_area_modulus = 0;                  ///< nN/um, per triangle, for mesh quality
  double bulk_modulus = 2.5;                      ///< kPa, K_V
  double nodal_friction = 0.1;                    ///< nN s/um per edge
  std::string nodal_friction_kind = "isotropic";  ///< or "axial"
  double ecm_friction = 0.1;                      ///< nN s/um^3
};

struct CbmBlock {               ///< centre-based parameters of a cell type (Table 1)
  std::optional<double> young;  ///< kPa; empty = 3 K_V (1 - 2 nu)
  double young_spread = 0.1;    ///< relative standard deviation per cell, truncated at 3 sigma
  double poisson = 0.47;
  double ecm_friction = 0.5;                  ///< nN s/um^3
  std::string stiffness_correction = "none";  ///< law file | none | auto (calibrate here)
};

/// Growth from V0 to 2 V0 at a constant rate, Eq. (18), then division.
struct CycleBlock {
  std::optional<double> time;     ///< s, mean time from birth to division; empty = no growth
  double spread = 0.1;            ///< relative standard deviation per cell, truncated at 3 sigma
  double mitosis = 3600;          ///< s after division in which daughters release their tension
  double force_ramp = 0.1;        ///< share of the cycle over which forces between new spheres rise
  std::string axis = "random";    ///< random | plane (random, horizontal) | given | vessel
  Vec3 direction = Vec3::Zero();  ///< axis = given; any length but zero
  std::string start = "birth";    ///< birth | random: where in the cycle the first cells stand
};

/// Factor on the growth rate. pressure: 1/(1 + (p/p0)^n) with p the contact pressure, 0 if cells
/// are pulled; density: the same with the number of cells around; volume: x^n/(1 + x^n) with x =
/// (V/V0)/threshold, for deformable cells only.
struct InhibitionBlock {
  std::string by = "none";        ///< none | pressure | volume | density
  double pressure_threshold = 0;  ///< kPa, p0 where growth is halved
  double density_threshold = 0;   ///< cells per um^3, where growth is halved
  double volume_threshold = 0;    ///< V/V0 where growth is halved
  double power = 4;               ///< n
};

struct DeathBlock {
  std::string mode = "removal";  ///< removal (at once) | lysis (shrink, then removal)
  double duration = 6 * 3600;    ///< s, lysis: time of shrinking
  double final_volume = 0.2;     ///< lysis: share of the volume left at the end
  double softening = 1;  ///< lysis: factor on cortex_young, bulk_modulus and adhesion meanwhile
};

struct CellType {
  double radius = 12;       ///< um at rest
  double adhesion = 0.01;   ///< nN/um (mJ/m^2... 1e-5 J/m^2), pair value = sqrt(Wa Wb)
  double diffusion = 1e-4;  ///< um^2/s, motility D (1e-16 m^2/s)
  CycleBlock cycle;
  InhibitionBlock inhibition;
  DeathBlock death;
  DcmBlock dcm;
  CbmBlock cbm;
};

struct ContactBlock {
  std::string quadrature = "3-point";  ///< or "nodes", "nodes-and-edges"
  double repulsion = 5;                ///< kPa/um (nN/um^3), k_rep
  std::optional<double> range;  ///< cohesive range in mean reference edges; empty = 0.3 (3-point),
                                ///< 0.5 (nodes), 0.35 (both)
  double max_depth = 1.5;       ///< um, deepest gap a contact point looks for
  double skin = 0.3;            ///< um
};

struct FrictionBlock {
  double dcm_dcm = 50;               ///< nN s/um^3
  double cbm_cbm = 10;               ///< nN s/um^3
  std::optional<double> dcm_cbm;     ///< empty = harmonic mean of the two
  std::optional<double> dcm_vessel;  ///< empty = the type's dcm ecm_friction
  std::optional<double> cbm_vessel;  ///< empty = the type's cbm ecm_friction
  std::string form = "surface";      ///< of dcm_dcm; or "nodes": node to node
  double range = 0.3;                ///< um, friction range of DCM contacts
  std::string medium = "ecm";        ///< or "liquid"
  double viscosity = 1e-6;           ///< nN s/um^2 (1e-3 Pa s), medium = liquid: Stokes drag
  std::string medium_area = "free";  ///< free | whole: which part of the surface feels the medium
};

struct MotilityBlock {
  bool random = true;
  std::string directions = "space";    ///< or "plane": the random force is horizontal
  double grid = 60;                    ///< s, time grid of the random force
  double leader_force = 0;             ///< nN, toward the vein axis
  double leader_grid = 600;            ///< s, re-evaluation of which cells lead
  std::string leaders = "foremost";    ///< foremost | front | border | sector | nearest
  int leader_count = 24;               ///< nearest: cells; sector: sectors of the whole circle
  std::optional<double> leader_slice;  ///< um, sector: height of a slice; empty = cell diameter
};

/// A region of space; which members count depends on `kind`.
struct Region {
  std::string kind;            ///< sphere | box | half_space | axis_distance | all
  Vec3 center = Vec3::Zero();  ///< sphere; um
  double radius = 0;           ///< sphere; um
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box; um
  Vec3 point = Vec3::Zero(),
       normal = Vec3::UnitZ();                ///< half_space: (x - point).normal <= 0 is inside
  double min_distance = 0, max_distance = 0;  ///< axis_distance: distance from the vein axis, um
};

/// Which cells rest or die, and when. A cell is meant if `region` and `cells` both are.
struct LifeRuleBlock {
  std::string action;               ///< key "do": rest (no growth while it holds) | die
  std::optional<Region> region;     ///< cells with their centre in it; empty = anywhere
  std::vector<std::int64_t> cells;  ///< lineage numbers; empty = all
  bool descendants = true;          ///< those of `cells` too
  double from = 0;                  ///< s after t = 0
  std::optional<double> until;      ///< s after t = 0; empty = the end
  double share = 1;                 ///< probability that a cell is meant, drawn once per cell
};

/// A rate at which cells of some layers enter the cycle.
struct EntryRateBlock {
  int first_layer = 1, last_layer = 1;
  double rate = 0;              ///< 1/s
  double from = 0;              ///< s after t = 0
  std::optional<double> until;  ///< s after t = 0; empty = the end
};

/// Cells rest until they enter the cycle, by their layer from the edge of the lesion.
struct ProliferationBlock {
  std::vector<EntryRateBlock> rates;
  std::string edge = "now";               ///< now | start: which edge layers are counted from
  std::optional<double> layer_thickness;  ///< um; empty = cell diameter
  int cells = 0;                          ///< none enters beyond this number; 0 = no limit
};

struct LifeBlock {
  std::vector<LifeRuleBlock> rules;
  std::optional<ProliferationBlock> proliferation;
  double grid = 600;             ///< s between two looks at rules, inhibition, sleep and meshes
  bool sleep = false;            ///< cells in balance are left out of the step until pushed
  double sleep_traction = 1e-3;  ///< kPa out of balance, below which a cell falls asleep
  bool remesh = true;            ///< cell meshes that degenerate are mended
};

struct CellEntry {
  Vec3 position = Vec3::Zero();  ///< um
  std::string type;              ///< empty = the only type
  std::optional<double> radius;  ///< um
  std::string model;             ///< "", "dcm" or "cbm" (overrides model and zoom)
  Vec3 pull = Vec3::Zero();      ///< nN, constant force spread over the cell
};

/// A type that generated cells may be of.
struct TypeShare {
  std::string type;
  double share = 1;              ///< weight against the other types for the same place
  std::optional<Region> region;  ///< cells with their centre in it; empty = all in no region
};

struct CellsBlock {
  std::string source = "list";  ///< list | clump | box | fill | lobule
  std::string model = "zoom";   ///< dcm | cbm | zoom (zoom regions say which cells are DCM)
  std::vector<CellEntry> list;
  std::vector<TypeShare> types;      ///< of generated cells; empty = the only type
  int count = 13;                    ///< clump: cells kept, nearest the centre first
  std::string lattice = "fcc";       ///< clump: fcc | bcc
  double spacing = 1.0;              ///< clump, box: centre distance in cell diameters
  double jitter = 0.0;               ///< clump, box: random displacement in cell diameters
  std::array<int, 3> grid{3, 3, 3};  ///< box: cells along x, y, z
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< fill: corners of the box, um
  double min_distance = 20;                      ///< fill: smallest centre distance, um
};

struct LobuleBlock {
  std::string shape = "pie";                              ///< pie | hexagon
  double radius = 280, height = 48, lesion_radius = 150;  ///< um
  double central_vein_radius = 10, portal_vein_radius = 15, sinusoid_radius = 4.7;  ///< um
  double vessel_fraction = 0.12;   ///< target volume fraction of sinusoids
  double branch_density = 4.8e-5;  ///< branch points per um^3
  double min_distance = 20;        ///< um, smallest centre distance of seeds
  int cells = 90;                  ///< wanted survivors
};

struct VesselBlock {
  std::string
      file;  ///< empty = none, or generated by the lobule; resolved against the scene's folder
  double unit = 1;            ///< um per file unit
  double scale = 1;           ///< factor on positions and radii
  double radius_scale = 1;    ///< further factor on radii
  Vec3 shift = Vec3::Zero();  ///< um, after scaling
  bool center = false;  ///< move the network's bounding box centre to the origin before the shift
  std::optional<std::array<Vec3, 2>> crop;  ///< keep segments with a part inside this box, um
  double young = 0.6;                       ///< kPa
  double poisson = 0.4;
  double adhesion = 0;  ///< nN/um
};

struct WallEntry {  ///< cells stay where (x - point).normal >= 0
  std::string name;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  double speed = 0;     ///< um/s along the normal (a moving wall), from t = 0
  double travel = 0;    ///< um, where the motion stops
  bool mirror = true;   ///< stands for equal cells on the other side: no adhesion, no friction
  double adhesion = 0;  ///< nN/um between cell and wall, not mirror
  std::optional<double> opens;  ///< s after t = 0, after which it is gone; empty = never
  std::optional<double> young;  ///< kPa, what spheres feel, not mirror; empty = rigid
  double poisson = 0;           ///< not mirror
};

struct CapsuleEntry {  ///< rigid sphere seen from inside
  bool enabled = false;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double speed = 0;  ///< um/s, shrink rate from t = 0
  double min_radius = 0;
  std::optional<double> opens;  ///< s after t = 0, after which it is gone; empty = never
};

struct StaticMeshEntry {
  std::string name, file;
  double unit = 1;  ///< um per file unit
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  bool inside = false;  ///< true: cells live inside it (normals are flipped)
};

struct OutputBlock {
  double every = 1800;  ///< s
  /// Further frames when a wall or the capsule opens, so many for every factor ten of the time
  /// since, from 1 s on; 0 = none.
  int after_opening = 0;
  std::string compression = "fast";  ///< none | fast
  bool start_up = false;             ///< also write frames at t < 0
};

struct Scene {
  std::string file;  ///< path it was read from
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  /// What is measured: free | lobule | patch | capsule | relaxation | spheroid | monolayer.
  std::string experiment = "free";
  std::string model;  ///< dcm | cbm | zoom: replaces cells.model; "" = cells.model stays
  TimeBlock time;
  SolverBlock solver;
  StartUpBlock start_up;
  std::map<std::string, CellType> cell_types;
  CellsBlock cells;
  LifeBlock life;
  std::vector<Region> zoom;        ///< union of regions
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical (z) through this point
  ContactBlock contact;
  FrictionBlock friction;
  MotilityBlock motility;
  std::optional<LobuleBlock> lobule;
  VesselBlock vessels;
  std::vector<WallEntry> walls;
  CapsuleEntry capsule;
  std::vector<StaticMeshEntry> static_meshes;
  OutputBlock output;

  std::string
      resolved_json;        ///< every key with its value, canonical order, as written to provenance
  std::string sha;          ///< hash of resolved_json
  std::string start_state;  ///< hash of the state in start_up.from; "" = none
};

}  // namespace acinus::runs
