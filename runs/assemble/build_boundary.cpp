#include "runs/assemble/build_boundary.hpp"

#include <fmt/format.h>

#include <utility>

#include "contact/wall_mesh.hpp"
#include "core/error.hpp"
#include "core/numbers/random.hpp"
#include "geometry/edit_network.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "geometry/readers/read_network.hpp"
#include "geometry/readers/read_surface.hpp"
#include "runs/assemble/cell_types.hpp"

namespace acinus::runs {
namespace {

geometry::Network read_vessels(const VesselBlock& v) {
  geometry::Network n = geometry::read_network(v.file, v.radius_array);
  n = geometry::transform_network(n, {v.unit, v.scale, v.radius_scale, v.center, v.shift});
  if (v.crop) n = geometry::crop_network(n, *v.crop);
  check(!n.segment.empty(),
        fmt::format("{}: no vessel segment is left inside /vessels/crop. Enlarge the box, or move "
                    "the network with shift or center.",
                    v.file));
  return geometry::resample_network(n);
}

constexpr const char* kCapsuleName = "capsule";
constexpr const char* kPipetteName = "pipette";

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

void add_static_meshes(const Scene& scene, contact::Boundary& boundary) {
  for (const StaticMeshEntry& m : scene.static_meshes) {
    for (geometry::Surface& s : geometry::read_closed_surfaces(m.file, m.unit * m.scale)) {
      for (Vec3& x : s.node) x += m.shift;
      boundary.meshes.push_back(contact::make_static_mesh(m.name, std::move(s), m.inside));
    }
  }
}

/// Adds the triangulated vessel surface as an obstacle if vessels.contact is "mesh".
/// Facets deviate from the cones of the network by a share of the radius proportional to the
/// squared edge length. They are finer than in files, so that contact pressures differ by 1 % from
/// those at the cones, not by 2 % (docs/howto/images.md).
void add_wall(const Scene& scene, contact::Vessels& vessels, Notes& notes) {
  if (scene.vessels.contact != VesselWalls::kMesh || vessels.network.segment.empty()) return;
  constexpr double kFineness = 0.15;
  geometry::VesselMesh mesh =
      geometry::make_vessel_mesh(vessels.network, {.fineness = kFineness, .attempts = 1});
  if (!mesh.is_as_expected()) notes.warnings.push_back(geometry::describe_connectivity(mesh));
  vessels.wall = std::make_shared<const contact::WallMesh>(
      contact::make_wall_mesh(vessels.network, std::move(mesh.surface)));
}

}  // namespace

coupling::LobuleParameters lobule_parameters(const Scene& scene) {
  coupling::LobuleParameters p = *scene.lobule;
  p.initial_radius = scene.start_up.enabled ? scene.start_up.initial_radius : largest_radius(scene);
  return p;
}

coupling::Lobule draw_lobule(const Scene& scene) {
  UniformStream stream(scene.seed, Purpose::kNetwork, 0);
  return coupling::make_lobule(lobule_parameters(scene), [&stream] { return stream.uniform(); });
}

geometry::Network build_network(const Scene& scene, const coupling::Lobule* lobule) {
  geometry::Network network;
  if (!scene.vessels.file.empty())
    network = read_vessels(scene.vessels);
  else if (lobule)
    network = lobule->vessels;
  if (scene.vessels.flexible && scene.vessels.spacing)
    network = geometry::split_network(network, *scene.vessels.spacing);
  return network;
}

geometry::Network build_network(const Scene& scene) {
  if (!scene.lobule) return build_network(scene, nullptr);
  const coupling::Lobule lobule = draw_lobule(scene);
  return build_network(scene, &lobule);
}

void add_boundary(const Scene& scene, const coupling::Lobule* lobule, contact::Boundary& boundary,
                  Notes& notes) {
  contact::set_network(boundary.vessels, build_network(scene, lobule));
  add_wall(scene, boundary.vessels, notes);
  boundary.vessels.material = {scene.vessels.adhesion, scene.vessels.young, scene.vessels.poisson,
                               contact::kVesselMaterial.mirror};
  if (lobule)
    for (const coupling::MirrorPlane& p : lobule->planes)
      boundary.planes.push_back(
          {p.name, p.point, p.normal, 0, 0, mirror(), contact::Plane{}.opens});
  for (const WallEntry& w : scene.walls)
    boundary.planes.push_back({w.name, w.point, w.normal.normalized(), w.speed, w.travel,
                               wall_material(w), w.opens.value_or(contact::Plane{}.opens)});
  if (scene.capsule.enabled)
    boundary.capsules.push_back({kCapsuleName,
                                 scene.capsule.center,
                                 scene.capsule.radius,
                                 scene.capsule.speed,
                                 scene.capsule.min_radius,
                                 scene.capsule.opens.value_or(contact::Capsule{}.opens),
                                 {}});
  if (scene.pipette) {
    contact::Pipette& tube = boundary.pipettes.emplace_back(*scene.pipette);
    tube.name = kPipetteName;
    tube.axis = scene.pipette->axis.normalized();
  }
  add_static_meshes(scene, boundary);
}

coupling::VesselTree build_tree(const Scene& scene, const geometry::Network& rest) {
  const VesselBlock& v = scene.vessels;
  if (!v.flexible || rest.segment.empty()) return {};
  coupling::VesselTree tree = coupling::make_tree(rest, v, v.anchors);
  check(v.anchors != coupling::VesselAnchors::kEnds || tree.has_ends(),
        "/vessels/anchors is \"ends\", but the network has no end: every node has two segments or "
        "more, so that nothing would hold it. Set vessels.anchors to \"none\", or crop the network "
        "so that vessels end.");
  return tree;
}

std::vector<std::string> boundary_names(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.lobule)
    for (const coupling::MirrorPlane& p : coupling::make_domain(lobule_parameters(scene)).plane)
      names.push_back(p.name);
  for (const WallEntry& w : scene.walls) names.push_back(w.name);
  if (scene.capsule.enabled) names.emplace_back(kCapsuleName);
  if (scene.pipette) names.emplace_back(kPipetteName);
  for (const StaticMeshEntry& m : scene.static_meshes) names.push_back(m.name);
  return names;
}

}  // namespace acinus::runs
