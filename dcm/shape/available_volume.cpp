#include "dcm/shape/available_volume.hpp"

#include <algorithm>
#include <utility>

#include "dcm/shape/cast.hpp"
#include "geometry/measures.hpp"
#include "geometry/star.hpp"

namespace acinus::dcm {
namespace {

/// Nodes of the sphere that samples an available volume and over whose faces meshes are spread.
constexpr int kShowingNodes = 642;
constexpr double kLeastShare = 0.25;
constexpr int kBisections = 50;

const geometry::Topology& showing_sphere() { return geometry::shared_icosphere(kShowingNodes); }

const std::vector<Vec3>& showing_directions() {
  static const std::vector<Vec3> directions = [] {
    std::vector<Vec3> all;
    for (const Vec3& rest : showing_sphere().rest) all.push_back(rest.normalized());
    return all;
  }();
  return directions;
}

}  // namespace

double share_of_distance(double radius, double other_radius, double distance) {
  const double share =
      0.5 * (1 + (radius * radius - other_radius * other_radius) / (distance * distance));
  return std::clamp(share, kLeastShare, 1 - kLeastShare);
}

double reach_to_faces(const Vec3& direction, double farthest, std::span<const VolumeFace> face) {
  double reach = farthest;
  for (const VolumeFace& f : face) {
    const double slope = f.normal.dot(direction);
    if (slope * reach > f.distance) reach = f.distance / slope;
  }
  return reach;
}

AvailableVolume::AvailableVolume(const Vec3& center, Reach reach)
    : center_(center), reach_(std::move(reach)) {
  for (const Vec3& direction : showing_directions()) shown_.push_back(reach_(direction));
}

std::vector<Vec3> AvailableVolume::show(double radius) const {
  std::vector<Vec3> node;
  for (std::size_t i = 0; i < shown_.size(); ++i)
    node.push_back(center_ + std::min(shown_[i], radius) * showing_directions()[i]);
  return node;
}

double AvailableVolume::volume(double radius) const {
  return geometry::compute_volume(show(radius), showing_sphere().triangle);
}

double AvailableVolume::find_radius(double wanted, double largest) const {
  if (volume(largest) <= wanted) return largest;
  double low = 0, high = largest;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (volume(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<Vec3> AvailableVolume::fill(const geometry::Topology& t,
                                        std::span<const Vec3> direction, double radius) const {
  std::vector<Vec3> cast;
  for (const Vec3& d : direction) cast.push_back(center_ + std::min(reach_(d), radius) * d);
  std::vector<Vec3> node = cast;
  const geometry::StarSurface star({show(radius), showing_sphere().triangle}, center_);
  const std::vector<Part> part(node.size(), Part::kShell);
  spread_nodes(t, star, {part, showing_sphere().n_triangle}, node);
  // Spreading evens out long triangles beside rims; where it does not help, the cast nodes are
  // used.
  return geometry::compute_quality(node, t.triangle) > geometry::compute_quality(cast, t.triangle)
             ? node
             : cast;
}

}  // namespace acinus::dcm
