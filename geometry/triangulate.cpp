#include "geometry/triangulate.hpp"

#include "core/error.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {

namespace {

// Seen along `normal`: a reflex corner gives no ear, nor one that covers another corner.
bool is_ear(const std::vector<int>& polygon, std::size_t k, std::span<const Vec3> node,
            const Vec3& normal) {
  const std::size_t n = polygon.size();
  const auto x = [&](std::size_t i) { return node[polygon[i % n]]; };
  const Vec3 a = x(k + n - 1), b = x(k), c = x(k + 1);
  if ((b - a).cross(c - b).dot(normal) <= 0) return false;
  for (std::size_t other = k + 2; other < k + n - 1; ++other) {
    const Vec3 p = x(other);
    if ((b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
        (a - c).cross(p - c).dot(normal) >= 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate(std::span<const int> corner,
                                            std::span<const Vec3> node) {
  ACINUS_ASSERT(corner.size() >= 3 && corner.size() <= kMaxPolygon);
  std::vector<int> polygon(corner.begin(), corner.end());
  std::vector<std::array<int, 3>> out;
  const auto x = [&](std::size_t i) { return node[polygon[i % polygon.size()]]; };
  Vec3 normal = Vec3::Zero();  // twice the vector area, about the first corner
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    normal += (x(k) - x(0)).cross(x(k + 1) - x(0));
  while (polygon.size() > 3) {
    const std::size_t n = polygon.size();
    std::size_t best = 0;
    double best_quality = -1;
    for (std::size_t k = 0; k < n; ++k) {
      const double quality = compute_triangle_quality(x(k + n - 1), x(k), x(k + 1));
      if (quality <= best_quality || !is_ear(polygon, k, node, normal)) continue;
      best = k;
      best_quality = quality;
    }
    out.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
  }
  out.push_back({polygon[0], polygon[1], polygon[2]});
  return out;
}

}  // namespace acinus::geometry
