#include "dcm/shape/inflate_mesh.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "geometry/audit_body.hpp"
#include "geometry/inner_ball.hpp"
#include "geometry/measures.hpp"

namespace acinus::dcm {
namespace {

/// Initial radius of the ball, over that of the largest one inside.
constexpr double kStart = 0.9;
/// Largest move outward and along the mesh in a sweep, in mean edges.
constexpr double kOutward = 0.15, kAlong = 0.5;
/// Distance that counts as on the surface, and largest move that counts as rest, in mean edges.
constexpr double kOnSurface = 0.02, kLeastMove = 0.01;
constexpr int kMostInflations = 600;

/// Quality of triangles that may not become worse.
constexpr double kQuality = 0.3;

class Balloon {
 public:
  Balloon(const geometry::Topology& topology, const geometry::AuditBody& body,
          std::vector<Vec3> node)
      : t_(topology), body_(body), node_(std::move(node)), on_surface_(node_.size(), 0) {}

  std::vector<Vec3> take_nodes() { return std::move(node_); }

  /// Moves every node once.
  /// @return largest move, in mean edges; 1 while some nodes are not at the surface
  double sweep() {
    edge_ = mean_edge();
    double farthest = 0;
    for (std::size_t i = 0; i < node_.size(); ++i) farthest = std::max(farthest, move(i));
    const bool all = std::ranges::all_of(on_surface_, [](char c) { return c != 0; });
    return all ? farthest / edge_ : 1;
  }

 private:
  double mean_edge() const {
    double sum = 0;
    for (const auto& [i, j] : t_.edge) sum += (node_[i] - node_[j]).norm();
    return sum / t_.n_edge;
  }
  std::span<const int> triangles_around(std::size_t i) const {
    const std::size_t first = t_.node_triangle_start[i], end = t_.node_triangle_start[i + 1];
    return std::span(t_.node_triangle).subspan(first, end - first);
  }

  double move(std::size_t i) {
    double size = 0;
    Vec3 moment = Vec3::Zero(), vector = Vec3::Zero();
    for (const int k : triangles_around(i)) {
      const auto& [a, b, c] = t_.triangle[k];
      const Vec3 part = 0.5 * (node_[b] - node_[a]).cross(node_[c] - node_[a]);
      size += part.norm();
      moment += part.norm() / 3 * (node_[a] + node_[b] + node_[c]);
      vector += part;
    }
    if (!(size > 0)) return 0;
    const Vec3 normal = vector.normalized(), middle = moment / size - node_[i];
    const Vec3 along = kAlong * (middle - normal * normal.dot(middle));
    for (const double share : {1.0, 0.3}) {
      char on_surface = on_surface_[i];
      const Vec3 to = step_from(node_[i] + share * along, share * normal, on_surface);
      if (!may_stand(i, to)) continue;
      const double far = (to - node_[i]).norm();
      node_[i] = to;
      on_surface_[i] = on_surface;
      return far;
    }
    return 0;
  }

  /// Outward step of a node, below the distance of the surface so that it is never passed; onto it
  /// if it is near.
  Vec3 step_from(const Vec3& x, const Vec3& normal, char& on_surface) const {
    const Vec3 nearest = body_.closest_point(x);
    const double distance = (nearest - x).norm();
    const double near = (on_surface != 0 ? kOutward : kOnSurface) * edge_;
    on_surface = distance < near || body_.locate(x) == geometry::Location::kOutside;
    if (on_surface != 0) return nearest;
    return x + std::min(kOutward * edge_, distance) * normal;
  }

  /// True if no triangle around a node is inverted, or becomes worse than permitted.
  bool may_stand(std::size_t i, const Vec3& to) const {
    for (const int k : triangles_around(i)) {
      std::array<Vec3, 3> before, after;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto corner = static_cast<std::size_t>(t_.triangle[k][c]);
        before[c] = node_[corner];
        after[c] = corner == i ? to : before[c];
      }
      const auto vector = [](const std::array<Vec3, 3>& v) -> Vec3 {
        return (v[1] - v[0]).cross(v[2] - v[0]);
      };
      if (!(vector(before).dot(vector(after)) > 0)) return false;
      const double quality = geometry::compute_triangle_quality(after[0], after[1], after[2]);
      if (quality < kQuality &&
          quality < geometry::compute_triangle_quality(before[0], before[1], before[2]))
        return false;
    }
    return true;
  }

  const geometry::Topology& t_;
  const geometry::AuditBody& body_;
  double edge_ = 0;  ///< um, mean
  std::vector<Vec3> node_;
  std::vector<char> on_surface_;
};

}  // namespace

std::vector<Vec3> inflate_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                               const Mat3& rotation) {
  const geometry::AuditBody body(surface.node, surface.triangle);
  const geometry::InnerBall ball = geometry::find_inner_ball(surface);
  std::vector<Vec3> node;
  for (const Vec3& x : topology.rest)
    node.push_back(ball.center + kStart * ball.radius * (rotation * x));
  Balloon balloon(topology, body, std::move(node));
  for (int sweep = 0; sweep < kMostInflations && balloon.sweep() > kLeastMove; ++sweep) {
  }
  return balloon.take_nodes();
}

}  // namespace acinus::dcm
