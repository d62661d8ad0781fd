#include "runs/build/build_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/mesh/measures.hpp"
#include "core/mesh/read_network.hpp"
#include "core/mesh/read_surface.hpp"
#include "core/random.hpp"
#include "core/sphere.hpp"
#include "coupling/generate/lobule.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/start_up.hpp"
#include "coupling/step/attempt.hpp"
#include "runs/build/build_correction.hpp"
#include "runs/build/build_life.hpp"
#include "runs/build/cell_types.hpp"
#include "runs/build/place_cells.hpp"
#include "runs/build/start_state.hpp"

namespace acinus::runs {
namespace {

mesh::Network read_vessels(const VesselBlock& v) {
  mesh::Network n = mesh::read_network(v.file);
  n = mesh::transform_network(n, {v.unit, v.scale, v.radius_scale, v.center, v.shift});
  if (v.crop) n = mesh::crop_network(n, *v.crop);
  check(!n.segment.empty(),
        fmt::format("{}: no vessel segment is left inside /vessels/crop. Enlarge the box, or move "
                    "the network with shift or center.",
                    v.file));
  return mesh::resample_network(n);
}

/// A uniformly distributed rotation of a cell's mesh.
Mat3 random_rotation(std::uint64_t seed, std::int64_t lineage) {
  UniformStream r(seed, Purpose::kPlacement, static_cast<std::uint64_t>(lineage) + 1);
  Eigen::Quaterniond q(r.normal(), r.normal(), r.normal(), r.normal());
  return q.normalized().toRotationMatrix();
}

constexpr const char* kCapsuleName = "capsule";

contact::Material mirror() {
  contact::Material m;
  m.mirror = true;
  return m;
}

contact::Material wall_material(const WallEntry& w) {
  contact::Material m = mirror();
  if (!w.mirror) m = {w.adhesion, w.young.value_or(contact::Material{}.young), w.poisson, false};
  return m;
}

coupling::LobuleParameters lobule_parameters(const Scene& scene) {
  const LobuleBlock& b = *scene.lobule;
  return {b.shape,
          b.radius,
          b.height,
          b.lesion_radius,
          b.central_vein_radius,
          b.portal_vein_radius,
          b.sinusoid_radius,
          b.vessel_fraction,
          b.branch_density,
          b.min_distance,
          b.cells,
          scene.start_up.enabled ? scene.start_up.initial_radius : largest_radius(scene)};
}

void add_surroundings(const Scene& scene, const coupling::Lobule* lobule,
                      contact::Surroundings& around) {
  mesh::Network network;
  if (!scene.vessels.file.empty())
    network = read_vessels(scene.vessels);
  else if (lobule)
    network = lobule->vessels;
  contact::set_network(around.vessels, std::move(network));
  around.vessels.material = {scene.vessels.adhesion, scene.vessels.young, scene.vessels.poisson,
                             false};
  if (lobule)
    for (const coupling::MirrorPlane& p : lobule->planes)
      around.planes.push_back({p.name, p.point, p.normal, 0, 0, mirror(), contact::Plane{}.opens});
  for (const WallEntry& w : scene.walls)
    around.planes.push_back({w.name, w.point, w.normal.normalized(), w.speed, w.travel,
                             wall_material(w), w.opens.value_or(contact::Plane{}.opens)});
  if (scene.capsule.enabled)
    around.capsules.push_back({kCapsuleName,
                               scene.capsule.center,
                               scene.capsule.radius,
                               scene.capsule.speed,
                               scene.capsule.min_radius,
                               scene.capsule.opens.value_or(contact::Capsule{}.opens),
                               {}});
  for (const StaticMeshEntry& m : scene.static_meshes) {
    for (mesh::Surface& s : mesh::read_closed_surfaces(m.file, m.unit * m.scale)) {
      contact::StaticMesh body;
      body.name = m.name;
      body.triangle = s.triangle;
      body.inside = m.inside;
      if (m.inside)
        for (auto& t : body.triangle) std::swap(t[1], t[2]);
      body.body.node = s.node;
      for (Vec3& x : body.body.node) x += m.shift;
      around.meshes.push_back(std::move(body));
    }
  }
  for (contact::StaticMesh& m : around.meshes) {  // addresses are final only now
    m.body.triangle = &m.triangle;
    contact::refresh_body(m.body);
  }
}

void add_cells(const Scene& scene, const std::vector<PlacedCell>& cells,
               const std::vector<std::string>& types, const std::vector<cbm::Params>& params,
               coupling::State& state) {
  std::vector<Vec3> centers;
  for (const PlacedCell& c : cells) centers.push_back(c.center);
  std::vector<dcm::NewCell> shells;
  std::vector<cbm::NewCell> spheres;
  for (int k : coupling::space_filling_order(centers)) {
    const PlacedCell& c = cells[static_cast<std::size_t>(k)];
    const CellType& t = scene.cell_types.at(c.type);
    const int type = static_cast<int>(std::ranges::find(types, c.type) - types.begin());
    if (c.deformable) {
      shells.push_back(
          {c.lineage, type, &mesh::shared_icosphere(t.dcm.nodes), c.center, c.radius, c.pull,
           c.oriented ? Mat3(Mat3::Identity()) : random_rotation(scene.seed, c.lineage)});
    } else {
      const double young =
          cbm::draw_young(params[static_cast<std::size_t>(type)], scene.seed, c.lineage);
      spheres.push_back({c.lineage, type, c.center, c.radius, young, c.pull});
    }
  }
  state.dcm = dcm::make_state(shells);
  state.cbm = cbm::make_state(spheres);
  state.next_lineage = static_cast<std::int64_t>(cells.size());
}

struct QuadratureChoice {
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double range_factor = 0.3;  ///< mean edges: the farther points are apart, the more they need
};

QuadratureChoice quadrature_of(const std::string& name) {
  if (name == "nodes") return {contact::Quadrature::kNodes, 0.5};
  if (name == "nodes-and-edges") return {contact::Quadrature::kNodesAndEdges, 0.35};
  return {};
}

coupling::Leaders leaders_of(const std::string& name) {
  if (name == "front") return coupling::Leaders::kFront;
  if (name == "border") return coupling::Leaders::kBorder;
  if (name == "sector") return coupling::Leaders::kSector;
  if (name == "nearest") return coupling::Leaders::kNearest;
  return coupling::Leaders::kForemost;
}

}  // namespace

dcm::Params make_dcm_params(const Scene& scene, const CellType& type) {
  const DcmBlock& d = type.dcm;
  dcm::Params p;
  p.cortex_thickness = d.cortex_thickness;
  p.spring_stiffness = dcm::cortex_spring_stiffness(d.cortex_young, d.cortex_thickness);
  p.bending_stiffness =
      dcm::cortex_bending_stiffness(d.cortex_young, d.cortex_thickness, d.cortex_poisson);
  p.area_modulus = d.area_modulus;
  p.local_area_modulus = d.local_area_modulus;
  p.bulk_modulus = d.bulk_modulus;
  p.nodal_friction = d.nodal_friction;
  p.axial_friction = d.nodal_friction_kind == "axial";
  p.medium_friction = d.ecm_friction;
  p.viscosity = scene.friction.medium == "liquid" ? scene.friction.viscosity : 0;
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.dcm_vessel.value_or(d.ecm_friction);
  return p;
}

cbm::Params make_cbm_params(const Scene& scene, const CellType& type) {
  cbm::Params p;
  p.young = type.cbm.young.value_or(cbm::young_from_bulk(type.dcm.bulk_modulus, type.cbm.poisson));
  p.young_spread = type.cbm.young_spread;
  p.poisson = type.cbm.poisson;
  p.medium_friction = type.cbm.ecm_friction;
  p.viscosity = scene.friction.medium == "liquid" ? scene.friction.viscosity : 0;
  p.whole_medium_area = scene.friction.medium_area == "whole";
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.cbm_vessel.value_or(type.cbm.ecm_friction);
  return p;
}

std::vector<std::string> boundary_names(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.lobule)
    for (const coupling::MirrorPlane& p : coupling::make_domain(lobule_parameters(scene)).plane)
      names.push_back(p.name);
  for (const WallEntry& w : scene.walls) names.push_back(w.name);
  if (scene.capsule.enabled) names.emplace_back(kCapsuleName);
  for (const StaticMeshEntry& m : scene.static_meshes) names.push_back(m.name);
  return names;
}

BuiltWorld build_world(const Scene& scene, const Ranks& ranks) {
  BuiltWorld built;
  coupling::World& world = built.world;
  coupling::Params& p = world.params;
  world.ranks = ranks;

  std::optional<coupling::Lobule> lobule;
  if (scene.lobule) {
    const LobuleBlock& b = *scene.lobule;
    UniformStream stream(scene.seed, Purpose::kNetwork, 0);
    lobule =
        coupling::make_lobule(lobule_parameters(scene), [&stream] { return stream.uniform(); });
    p.motility.axis_radius = b.central_vein_radius;
    if (static_cast<int>(lobule->seeds.size()) < b.cells)
      built.notes.push_back(
          fmt::format("room for {} of the {} cells asked for", lobule->seeds.size(), b.cells));
    double cells = 0;
    for (std::size_t k = 0; k < lobule->seeds.size(); ++k)
      cells += sphere_volume(
          scene.cell_types
              .at(type_of_generated(scene, static_cast<std::int64_t>(k), lobule->seeds[k]))
              .radius);
    const double lesion = b.shape == "pie" ? kPi * b.lesion_radius * b.lesion_radius / 6
                                           : kPi * b.lesion_radius * b.lesion_radius;
    built.notes.push_back(
        fmt::format("lobule {}: height {} um, {} cells at least {} um apart fill {:.2f} of the "
                    "volume outside the lesion",
                    b.shape, b.height, lobule->seeds.size(), b.min_distance,
                    cells / (lobule->volume - lesion * b.height)));
  }
  add_surroundings(scene, lobule ? &*lobule : nullptr, p.around);
  built.vessel_length = mesh::total_length(p.around.vessels.network);

  for (const auto& [name, type] : scene.cell_types) {
    built.type_names.push_back(name);
    p.dcm.push_back(make_dcm_params(scene, type));
    p.cbm.push_back(make_cbm_params(scene, type));
  }
  build_corrections(scene, p.cbm, built.notes);
  build_life(scene, p, built.type_names);
  const auto [quadrature, range_factor] = quadrature_of(scene.contact.quadrature);
  p.dcm_contact.quadrature = quadrature;
  p.dcm_contact.repulsion = scene.contact.repulsion;
  p.dcm_contact.range_factor = scene.contact.range.value_or(range_factor);
  p.dcm_contact.friction_range = scene.friction.range;
  p.dcm_contact.whole_medium_area = scene.friction.medium_area == "whole";
  p.dcm_contact.max_depth = scene.contact.max_depth;
  p.dcm_contact.skin = p.cbm_contact.skin = scene.contact.skin;
  p.dcm_contact.cell_friction = scene.friction.dcm_dcm;
  if (scene.friction.form == "nodes") p.dcm_contact.friction_form = dcm::FrictionForm::kNodes;
  p.cbm_contact.cell_friction = scene.friction.cbm_cbm;
  const double a = scene.friction.dcm_dcm, b = scene.friction.cbm_cbm;
  p.interface.friction = scene.friction.dcm_cbm.value_or(a + b > 0 ? 2 * a * b / (a + b) : 0);
  p.start_up = {scene.start_up.enabled,         scene.start_up.growth_time,
                scene.start_up.adhesion_ramp,   scene.start_up.max_duration,
                scene.start_up.speed_tolerance, scene.start_up.pressure_tolerance};
  p.motility.seed = scene.seed;
  p.motility.random = scene.motility.random;
  p.motility.in_plane = scene.motility.directions == "plane";
  p.motility.grid = scene.motility.grid;
  p.motility.leader_force = scene.motility.leader_force;
  p.motility.leader_grid = scene.motility.leader_grid;
  p.motility.leaders = leaders_of(scene.motility.leaders);
  p.motility.leader_count = scene.motility.leader_count;
  p.motility.leader_slice =
      scene.motility.leader_slice.value_or(2 * scene.cell_types.begin()->second.radius);
  p.motility.axis_point = scene.axis_point;
  p.numerics = {scene.time.step,     scene.time.min_step,
                scene.time.adaptive, scene.time.tolerance,
                scene.time.max_move, {scene.solver.tolerance, scene.solver.max_iterations}};
  p.numerics.extrapolate = scene.time.extrapolate;
  for (const auto method : {coupling::Integrator::kExplicitEuler, coupling::Integrator::kRos2,
                            coupling::Integrator::kNewton})
    if (scene.time.integrator == coupling::name_of(method)) p.numerics.integrator = method;
  // An explicit step's length is set by stability, not by what an error estimate asks for.
  if (p.numerics.integrator == coupling::Integrator::kExplicitEuler) p.numerics.adaptive = false;

  if (!scene.start_up.from.empty()) {
    built.notes.push_back(take_start(scene, world.state));
    coupling::begin_life(world);
    return built;
  }
  std::vector<PlacedCell> cells = place_cells(scene, lobule ? &*lobule : nullptr, p.around);
  for (PlacedCell& c : cells) {  // older cells are larger
    const auto type = static_cast<std::size_t>(
        std::distance(scene.cell_types.begin(), scene.cell_types.find(c.type)));
    c.radius *= std::cbrt(1 + coupling::draw_start_age(p.life.type[type], scene.seed, c.lineage));
  }
  check_starts(scene, cells, p.around);
  add_cells(scene, cells, built.type_names, p.cbm, world.state);
  if (scene.start_up.enabled)
    coupling::begin_start_up(world, scene.start_up.initial_radius);
  else
    coupling::begin_life(world);
  return built;
}

}  // namespace acinus::runs
