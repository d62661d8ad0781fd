#include "runs/images/voxelise_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "geometry/measures.hpp"
#include "geometry/topology.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/scene/reader.hpp"

namespace acinus::runs {
namespace {

constexpr std::uint8_t kDeformable = 0, kSphereKind = 1;  // io::Frame::kind
constexpr int kSphereNodes = 642;

Vec3 point_of(const io::Frame& f, std::int64_t k) {
  const auto at = static_cast<std::size_t>(3 * k);
  return {f.point[at], f.point[at + 1], f.point[at + 2]};
}

/// Closed surfaces of all cells of a frame by lineage: meshes as they are, spheres as icospheres.
/// Coordinates in um.
std::map<std::int64_t, geometry::Surface> surfaces_of(const io::Frame& f) {
  std::map<std::int64_t, geometry::Surface> out;
  std::map<std::pair<std::int64_t, std::int64_t>, int> number;  // of a node among those of a cell
  for (std::size_t t = 0; t < f.triangle.size(); ++t) {
    if (f.kind[t] != kDeformable) continue;
    geometry::Surface& s = out[f.cell_id[t]];
    std::array<int, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] =
          number.try_emplace({f.cell_id[t], f.triangle[t][k]}, static_cast<int>(s.node.size()));
      if (fresh) s.node.push_back(point_of(f, f.triangle[t][k]));
      corner[k] = at->second;
    }
    s.triangle.push_back(corner);
  }
  const geometry::Topology& ball = geometry::shared_icosphere(kSphereNodes);
  for (const io::Field& field : f.cell_data) {
    if (field.name != "radius") continue;
    for (std::int64_t k = 0; k < f.n_sphere; ++k) {
      const std::size_t at = f.triangle.size() + static_cast<std::size_t>(k);
      if (f.kind[at] != kSphereKind) continue;
      geometry::Surface s;
      s.triangle = ball.triangle;
      for (const Vec3& x : ball.rest)
        s.node.push_back(point_of(f, f.n_mesh_node + k) + static_cast<double>(field.value[at]) * x);
      out[f.cell_id[at]] = std::move(s);
    }
  }
  return out;
}

std::optional<geometry::Surface> vessels_of(const io::RunReader& run, const std::string& folder) {
  const auto provenance = run.provenance();
  const auto text = provenance.find("scene");
  if (text == provenance.end()) return std::nullopt;
  const Scene scene = parse_scene(text->second, folder, folder);
  const geometry::Network network = build_network(scene);
  if (network.segment.empty()) return std::nullopt;
  check(!scene.vessels.flexible,
        fmt::format("{}: its vessels bend, and a frame does not say where to; leave them out with "
                    "--no-vessels.",
                    folder));
  constexpr double kFineness = 0.3;  // a voxel may be small beside what is good enough to look at
  return geometry::make_vessel_mesh(network, {.fineness = kFineness}).surface;
}

}  // namespace

RunImage voxelise_run(const VoxeliseRun& o) {
  const io::RunReader run((std::filesystem::path(o.folder) / "run.vtkhdf").string());
  const int frames = run.n_frame();
  check(frames > 0, fmt::format("{}: the run has no frame yet.", o.folder));
  check(o.frame < frames,
        fmt::format("{}: --frame {}: the run has {}, numbered from 0.", o.folder, o.frame, frames));
  RunImage out;
  out.frame = o.frame < 0 ? frames - 1 : o.frame;
  std::vector<geometry::Surface> body;
  for (auto& [lineage, surface] : surfaces_of(run.frame(out.frame))) {
    out.cell.push_back({static_cast<imaging::Label>(body.size()) + 1, lineage,
                        geometry::compute_volume(surface.node, surface.triangle),
                        geometry::compute_centroid(surface.node, surface.triangle)});
    body.push_back(std::move(surface));
  }
  check(!body.empty(), fmt::format("{}: frame {} has no cells.", o.folder, out.frame));
  if (o.vessels)
    if (auto vessels = vessels_of(run, o.folder)) {
      body.push_back(std::move(*vessels));
      out.vessels = static_cast<imaging::Label>(body.size());
    }
  imaging::VoxelisedBodies made = imaging::voxelise(body, o.how);
  out.image = std::move(made.image);
  for (LabelledCell& c : out.cell) c.center -= made.corner;
  return out;
}

std::string labels_text(const RunImage& image) {
  std::string text = "label,cell,volume_um3,x_um,y_um,z_um\n";
  for (const LabelledCell& c : image.cell)
    text += fmt::format("{},{},{:.7g},{:.7g},{:.7g},{:.7g}\n", c.label, c.lineage, c.volume,
                        c.center[0], c.center[1], c.center[2]);
  return text;
}

}  // namespace acinus::runs
