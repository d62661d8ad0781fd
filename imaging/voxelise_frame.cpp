#include "imaging/voxelise_frame.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "geometry/measures.hpp"
#include "geometry/topology.hpp"

namespace acinus::imaging {
namespace {

constexpr int kSphereNodes = 642;

Vec3 point_of(const io::Frame& f, std::int64_t k) {
  const std::size_t at = 3 * k;
  return {f.point[at], f.point[at + 1], f.point[at + 2]};
}

}  // namespace

CellSurfaces frame_surfaces(const io::Frame& f) {
  CellSurfaces out;
  std::map<std::pair<std::int64_t, std::int64_t>, int> number;  // of a node among those of a cell
  for (std::size_t t = 0; t < f.triangle.size(); ++t) {
    if (f.kind[t] != io::kShell) continue;
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
      const std::size_t at = f.triangle.size() + k;
      if (f.kind[at] != io::kSphere) continue;
      geometry::Surface s;
      s.triangle = ball.triangle;
      for (const Vec3& x : ball.rest)
        s.node.push_back(point_of(f, f.n_mesh_node + k) + static_cast<double>(field.value[at]) * x);
      out[f.cell_id[at]] = std::move(s);
    }
  }
  return out;
}

CellImage voxelise_cells(CellSurfaces cells, std::optional<geometry::Surface> vessels,
                         const Voxelise& how) {
  CellImage out;
  std::vector<geometry::Surface> body;
  for (auto& [lineage, surface] : cells) {
    out.cell.push_back({static_cast<Label>(body.size()) + 1, lineage,
                        geometry::compute_volume(surface.node, surface.triangle),
                        geometry::compute_centroid(surface.node, surface.triangle)});
    body.push_back(std::move(surface));
  }
  if (vessels) {
    body.push_back(std::move(*vessels));
    out.vessels = static_cast<Label>(body.size());
  }
  VoxelisedBodies made = voxelise(body, how);
  out.image = std::move(made.image);
  for (LabelledCell& c : out.cell) c.center -= made.corner;
  return out;
}

std::string labels_text(const CellImage& image) {
  std::string text = "label,cell,volume_um3,x_um,y_um,z_um\n";
  for (const LabelledCell& c : image.cell)
    text += fmt::format("{},{},{:.7g},{:.7g},{:.7g},{:.7g}\n", c.label, c.lineage, c.volume,
                        c.center[0], c.center[1], c.center[2]);
  return text;
}

}  // namespace acinus::imaging
