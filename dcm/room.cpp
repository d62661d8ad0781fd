#include "dcm/room.hpp"

#include <algorithm>

#include "core/mesh/measures.hpp"
#include "core/mesh/star.hpp"
#include "dcm/cast.hpp"

namespace acinus::dcm {
namespace {

/// Nodes of the sphere that shows the room to the nodes that are spread over it.
constexpr int kShowingNodes = 2562;
constexpr double kLeastShare = 0.25;

mesh::Surface show_room(const Vec3& center, double radius, std::span<const RoomFace> face) {
  const mesh::Topology& sphere = mesh::shared_icosphere(kShowingNodes);
  mesh::Surface surface;
  surface.triangle = sphere.triangle;
  for (const Vec3& rest : sphere.rest) {
    const Vec3 direction = rest.normalized();
    surface.node.push_back(center + reach_of_room(direction, radius, face) * direction);
  }
  return surface;
}

}  // namespace

double share_of_distance(double radius, double other_radius, double distance) {
  const double power =
      0.5 * (1 + (radius * radius - other_radius * other_radius) / (distance * distance));
  return std::clamp(power, kLeastShare, 1 - kLeastShare);
}

double reach_of_room(const Vec3& direction, double radius, std::span<const RoomFace> face) {
  double reach = radius;
  for (const RoomFace& f : face) {
    const double slope = f.normal.dot(direction);
    if (slope * reach > f.distance) reach = f.distance / slope;
  }
  return reach;
}

std::vector<Vec3> fill_room(const mesh::Topology& t, std::span<const Vec3> direction,
                            const Vec3& center, double radius, std::span<const RoomFace> face) {
  std::vector<Vec3> cast;
  for (const Vec3& d : direction) cast.push_back(center + reach_of_room(d, radius, face) * d);
  std::vector<Vec3> node = cast;
  const mesh::StarSurface star(show_room(center, radius, face), center);
  const std::vector<Part> part(node.size(), Part::kShell);
  const int n_face = mesh::shared_icosphere(kShowingNodes).n_triangle;
  spread_nodes(t, star, {part, n_face}, node);
  // Spreading evens out long triangles beside rims; where it does not help, rays will do.
  const bool better =
      mesh::compute_quality(node, t.triangle) > mesh::compute_quality(cast, t.triangle);
  return better ? node : cast;
}

}  // namespace acinus::dcm
