#include "dcm/lay_mesh.hpp"

#include "core/mesh/measures.hpp"
#include "core/mesh/star.hpp"
#include "dcm/cast.hpp"
#include "dcm/split.hpp"

namespace acinus::dcm {

std::optional<std::vector<Vec3>> lay_mesh(const mesh::Topology& topology,
                                          const mesh::Surface& surface, const Mat3& rotation) {
  const std::optional<Vec3> center = mesh::find_star_center(surface);
  if (!center) return std::nullopt;
  std::optional<std::vector<Vec3>> node = cast_sphere(topology, surface, *center, rotation);
  if (!node) return std::nullopt;
  const std::vector<Part> part(node->size(), Part::kShell);
  spread_nodes(topology, mesh::StarSurface(surface, *center),
               {part, static_cast<int>(surface.triangle.size())}, *node);
  const double volume = mesh::compute_volume(surface.node, surface.triangle);
  const std::vector<double> weight(node->size(), 1);
  if (!match_volume(topology, volume, weight, *node) || !faces_outward(topology, *node, *center))
    return std::nullopt;
  return node;
}

}  // namespace acinus::dcm
