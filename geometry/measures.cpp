#include "geometry/measures.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace acinus::geometry {

namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners corners_of(std::span<const Vec3> node, const std::array<int, 3>& triangle,
                   const Vec3& origin) {
  return {node[triangle[0]] - origin, node[triangle[1]] - origin, node[triangle[2]] - origin};
}

Vec3 origin_of(std::span<const Vec3> node, Triangles triangle) {
  return triangle.empty() ? Vec3::Zero() : node[triangle[0][0]];
}

ClosestPoint closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b, int from, int to) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  ClosestPoint out;
  out.weight[from] = 1 - s;
  out.weight[to] = s;
  out.point = a + s * ab;
  out.squared_distance = (p - out.point).squaredNorm();
  return out;
}

}  // namespace

double compute_volume(std::span<const Vec3> node, Triangles triangle) {
  const Vec3 origin = origin_of(node, triangle);
  double six = 0;
  for (const auto& t : triangle) {
    const auto [a, b, c] = corners_of(node, t, origin);
    six += a.dot(b.cross(c));
  }
  return six / 6;
}

double compute_area(std::span<const Vec3> node, Triangles triangle) {
  double twice = 0;
  for (const auto& t : triangle) {
    const auto [a, b, c] = corners_of(node, t, Vec3::Zero());
    twice += (b - a).cross(c - a).norm();
  }
  return twice / 2;
}

Vec3 compute_centroid(std::span<const Vec3> node, Triangles triangle) {
  const Vec3 origin = origin_of(node, triangle);
  double six = 0;
  Vec3 moment = Vec3::Zero();
  for (const auto& t : triangle) {
    const auto [a, b, c] = corners_of(node, t, origin);
    const double part = a.dot(b.cross(c));
    six += part;
    moment += part * (a + b + c);
  }
  return origin + moment / (4 * six);
}

MeanCurvature compute_mean_curvature(std::span<const Vec3> node, Triangles triangle) {
  MeanCurvature out;
  out.normal.assign(node.size(), Vec3::Zero());
  out.mixed_area.assign(node.size(), 0.0);
  for (const auto& t : triangle) {
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = node[t[k]];
    const double twice_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
    if (twice_area == 0) continue;
    Vec3 cot;
    int obtuse = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double dot = (x[(k + 1) % 3] - x[k]).dot(x[(k + 2) % 3] - x[k]);
      cot[static_cast<int>(k)] = dot / twice_area;
      if (dot < 0) obtuse = static_cast<int>(k);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      const double cot_next = cot[static_cast<int>(next)], cot_last = cot[static_cast<int>(last)];
      const std::size_t i = t[k];
      out.normal[i] += cot_last * (x[k] - x[next]) + cot_next * (x[k] - x[last]);
      if (obtuse < 0) {  // Voronoi part of the triangle
        out.mixed_area[i] += (cot_last * (x[k] - x[next]).squaredNorm() +
                              cot_next * (x[k] - x[last]).squaredNorm()) /
                             8;
      } else {
        out.mixed_area[i] += twice_area / (obtuse == static_cast<int>(k) ? 4 : 8);
      }
    }
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (out.mixed_area[i] > 0) out.normal[i] /= 4 * out.mixed_area[i];
  }
  return out;
}

ClosestPoint find_closest_point_of_sliver(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c) {
  ClosestPoint best = closest_on_segment(p, a, b, 0, 1);
  for (const ClosestPoint& other :
       {closest_on_segment(p, b, c, 1, 2), closest_on_segment(p, c, a, 2, 0)}) {
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

double compute_triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares : 0.0;
}

double compute_quality(std::span<const Vec3> node, Triangles triangle) {
  double quality = 1;
  for (const auto& t : triangle) {
    const auto [a, b, c] = corners_of(node, t, Vec3::Zero());
    quality = std::min(quality, compute_triangle_quality(a, b, c));
  }
  return quality;
}

double compute_distance(const Vec3& p, std::span<const Vec3> node, Triangles triangle) {
  double squared = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangle)
    squared = std::min(squared, find_closest_point(p, node[a], node[b], node[c]).squared_distance);
  return std::sqrt(squared);
}

double compute_winding_number(const Vec3& p, std::span<const Vec3> node, Triangles triangle) {
  double half_angle = 0;
  for (const auto& t : triangle) {
    const auto [a, b, c] = corners_of(node, t, p);
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angle +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angle / (2 * kPi);
}

bool is_inside(const Vec3& p, std::span<const Vec3> node, Triangles triangle) {
  return compute_winding_number(p, node, triangle) > 0.5;
}

}  // namespace acinus::geometry
