/// Command `acinus mesh`.

#include <memory>

#include "cli/command.hpp"
#include "core/parallel/clock.hpp"
#include "core/parallel/threads.hpp"
#include "core/units/dimension.hpp"
#include "geometry/edit_network.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "geometry/measures.hpp"
#include "geometry/readers/input_file.hpp"
#include "geometry/readers/read_network.hpp"
#include "geometry/readers/read_surface.hpp"
#include "geometry/wrap.hpp"
#include "io/surface_file.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::cli {
namespace {

struct MeshArguments {
  std::string what, out, unit = "1 um", edge, alpha, offset, radius_array;
  double fineness = geometry::VesselMeshOptions{}.fineness;
  double rounding = geometry::VesselMeshOptions{}.rounding;
  int threads = 0;
  bool quiet = false, unit_given = false;
};

void start(const MeshArguments& a) {
  io::check_surface_file(a.out);
  set_threads(a.threads > 0 ? a.threads : processor_count());
}

void tell(const MeshArguments& a, const geometry::Surface& s, const geometry::Connectivity& c,
          double seconds) {
  if (a.quiet) return;
  fmt::print(
      "{}: {} triangles, {} nodes, area {:.4g} um^2, volume {:.4g} um^3, {} part{}, {} "
      "handle{}, {:.1f} s\n",
      a.out, s.triangle.size(), s.node.size(), geometry::compute_area(s.node, s.triangle),
      geometry::compute_volume(s.node, s.triangle), c.parts, c.parts == 1 ? "" : "s", c.handles(),
      c.handles() == 1 ? "" : "s", seconds);
}

geometry::Network find_network(const MeshArguments& a) {
  const std::string ending = geometry::extension_of(a.what);
  if (ending.empty() || ending == ".json") {  // a scene, or the name of a shipped one
    check(a.radius_array.empty() && !a.unit_given,
          fmt::format("{}: --unit and --vessel-radius-array are for a network file; a scene says "
                      "vessels.unit and vessels.radius_array itself. Leave them out.",
                      a.what));
    const runs::Scene scene = runs::read_scene(runs::find_scene_file(a.what), {});
    geometry::Network n = runs::build_network(scene);
    check(!n.segment.empty(), fmt::format("{}: the scene has no vessels", a.what));
    return n;
  }
  geometry::NetworkTransform to_um;
  to_um.unit = quantity_of("--unit", a.unit, kLength);
  return geometry::resample_network(
      geometry::transform_network(geometry::read_network(a.what, a.radius_array), to_um));
}

int mesh_vessels(const MeshArguments& a) {
  start(a);
  const double before = wall_seconds();
  geometry::VesselMeshOptions o;
  o.fineness = a.fineness;
  o.rounding = a.rounding;
  if (!a.edge.empty()) o.edge = quantity_of("--edge", a.edge, kLength);
  const geometry::Network network = find_network(a);
  const geometry::VesselMesh m = [&] {
    try {
      return geometry::make_vessel_mesh(network, o);
    } catch (const Error& error) {  // which knows no file
      throw Error(fmt::format("{}: {}", a.what, error.what()), error.code());
    }
  }();
  io::write_surface(a.out, m.surface);
  tell(a, m.surface, m.found, wall_seconds() - before);
  if (o.edge > 0 && !m.remeshed)
    fmt::print(stderr,
               "acinus: warning: with triangles of {} the surface would cross itself or lose a "
               "vessel; written as it was before, each vessel with triangles of its own size. Try "
               "a smaller --edge.\n",
               a.edge);
  if (!m.is_as_expected())
    fmt::print(stderr, "acinus: warning: {}. Look at the surface there{}.\n",
               geometry::describe_connectivity(m),
               m.overlapping > 0 ? "" : "; a smaller --fineness may help");
  return 0;
}

int mesh_wrap(const MeshArguments& a) {
  start(a);
  const double before = wall_seconds();
  geometry::Surface all;
  Box box;
  for (const geometry::Surface& s :
       geometry::read_surfaces(a.what, quantity_of("--unit", a.unit, kLength))) {
    const int first = static_cast<int>(all.node.size());
    all.node.insert(all.node.end(), s.node.begin(), s.node.end());
    for (const auto& [i, j, k] : s.triangle)
      all.triangle.push_back({first + i, first + j, first + k});
    for (const Vec3& x : s.node) box.include(x);
  }
  constexpr double kAlphasPerExtent = 50, kOffsetsPerExtent = 20, kMostAlphasPerExtent = 2000;
  const double extent = (box.high - box.low).norm();
  const double alpha =
      a.alpha.empty() ? extent / kAlphasPerExtent : quantity_of("--alpha", a.alpha, kLength);
  const double offset =
      a.offset.empty() ? alpha / kOffsetsPerExtent : quantity_of("--offset", a.offset, kLength);
  check(extent > 0 && extent <= kMostAlphasPerExtent * alpha &&
            extent <= kMostAlphasPerExtent * kOffsetsPerExtent * offset,
        fmt::format("{}: is {:.4g} um across; --alpha {:.4g} um and --offset {:.4g} um must be at "
                    "least {:.4g} and {:.4g} um for it, or the surface never ends. Check the unit, "
                    "or nodes far away.",
                    a.what, extent, alpha, offset, extent / kMostAlphasPerExtent,
                    extent / kMostAlphasPerExtent / kOffsetsPerExtent));
  const geometry::Surface wrapped = geometry::wrap(all, alpha, offset);
  io::write_surface(a.out, wrapped);
  tell(a, wrapped, geometry::compute_connectivity(wrapped), wall_seconds() - before);
  return 0;
}

void add_common(CLI::App& command, MeshArguments& a) {
  command.add_option("--out", a.out, "the surface: .vtk, .vtp, .stl or .obj, in um")
      ->type_name("FILE")
      ->required();
  command.add_option("--unit", a.unit, "length of one unit of the file (default: 1 um)")
      ->type_name("LENGTH");
  add_threads(command, a.threads);
  command.add_flag("--quiet", a.quiet, "errors and warnings only");
}

}  // namespace

Command add_mesh(CLI::App& app) {
  CLI::App* command =
      add_command(app, "mesh", "make closed surfaces: of vessels, about meshes with holes",
                  "acinus mesh vessels tree.swc --out tree.vtp");
  command->require_subcommand(1);
  const auto arguments = std::make_shared<MeshArguments>();
  CLI::App* vessels =
      add_command(*command, "vessels", "one closed surface about a network of vessels",
                  "acinus mesh vessels tree.swc --edge \"1.5 um\" --out tree.stl\n"
                  "         acinus mesh vessels lobule_hybrid --out sinusoids.vtp");
  vessels
      ->add_option("WHAT", arguments->what,
                   "network (.vtk, .swc, .vmv), scene file, or the name of a shipped scene")
      ->required();
  vessels
      ->add_option("--edge", arguments->edge,
                   "make all triangles alike, with sides near this (default: each vessel has "
                   "triangles of its own size)")
      ->type_name("LENGTH");
  vessels
      ->add_option("--fineness", arguments->fineness,
                   "side of a triangle over the radius of its vessel (default: 0.4)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.05, 1.0));
  vessels
      ->add_option("--rounding", arguments->rounding,
                   "how far creases at branch points are rounded, over the radius there (default: "
                   "0.1)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0));
  vessels
      ->add_option("--vessel-radius-array", arguments->radius_array,
                   "name of the array of radii in a VTK file (default: one of the usual names)")
      ->type_name("NAME");
  add_common(*vessels, *arguments);
  CLI::App* wrap = add_command(
      *command, "wrap", "one closed surface about meshes that have holes or cross themselves",
      "acinus mesh wrap dirty.stl --alpha \"5 um\" --offset \"0.2 um\" --out clean.stl");
  wrap->add_option("FILE", arguments->what, "surfaces (.vtk, .obj, .stl, .ply)")->required();
  wrap->add_option("--alpha", arguments->alpha,
                   "holes narrower than this are closed (default: a fiftieth of the extent)")
      ->type_name("LENGTH");
  wrap->add_option("--offset", arguments->offset,
                   "how far the new surface is outside (default: a twentieth of --alpha)")
      ->type_name("LENGTH");
  add_common(*wrap, *arguments);
  return {command, [arguments, vessels] {
            arguments->unit_given = vessels->count("--unit") > 0;
            return vessels->parsed() ? mesh_vessels(*arguments) : mesh_wrap(*arguments);
          }};
}

}  // namespace acinus::cli
