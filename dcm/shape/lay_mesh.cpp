#include "dcm/shape/lay_mesh.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "dcm/shape/cast.hpp"
#include "dcm/shape/inflate_mesh.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "geometry/star.hpp"

namespace acinus::dcm {
namespace {

/// Least quality of the triangles of an accepted mesh.
constexpr double kLeastQuality = 0.1;

/// Makes the volume exact; returns the defect of the mesh, empty if it has none.
std::string finish(const geometry::Topology& topology, double volume, std::vector<Vec3>& node) {
  const std::vector<double> weight(node.size(), 1);
  if (!match_volume(topology, volume, weight, node))
    return fmt::format("the mesh has {:.2f} of its volume",
                       geometry::compute_volume(node, topology.triangle) / volume);
  const double quality = geometry::compute_quality(node, topology.triangle);
  if (quality < kLeastQuality) return fmt::format("a triangle has the quality {:.2f}", quality);
  if (geometry::AuditBody(node, topology.triangle).self_intersects())
    return "the mesh crosses itself";
  return {};
}

}  // namespace

LaidMesh lay_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                  const Mat3& rotation) {
  const double volume = geometry::compute_volume(surface.node, surface.triangle);
  LaidMesh out;
  std::optional<std::vector<Vec3>> cast;
  if (const std::optional<Vec3> center = geometry::find_star_center(surface))
    cast = cast_and_spread(topology, surface, *center, rotation);
  if (cast) {
    out.node = std::move(*cast);
    out.fault = finish(topology, volume, out.node);
    if (out.fault.empty()) return out;
  }
  out.inflated = true;
  out.node = inflate_mesh(topology, surface, rotation);
  out.fault = finish(topology, volume, out.node);
  return out;
}

}  // namespace acinus::dcm
