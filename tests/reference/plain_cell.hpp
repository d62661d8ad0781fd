#pragma once
/// Energies of one deformable cell, one node at a time and from the definitions: the twins of the
/// kernels in dcm/terms. They use only nodes, triangles and the rest nodes, none of the tables that
/// the kernels read.

#include <cmath>
#include <vector>

#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::reference {

struct PlainCell {
  const geometry::Topology* topology;
  std::vector<Vec3> node;  ///< um
  double radius;           ///< um, reference radius
};

inline const Vec3& at(const std::vector<Vec3>& x, int i) { return x[i]; }

inline std::vector<Vec3> rest_nodes(const PlainCell& c) {
  std::vector<Vec3> x = c.topology->rest;
  for (Vec3& p : x) p *= c.radius;
  return x;
}

/// Sum over edges, 1/2 k (l - l0)^2: every edge is met twice in the triangles, once each way.
inline double plain_cortex_energy(const PlainCell& c, double stiffness) {
  const std::vector<Vec3> rest = rest_nodes(c);
  double sum = 0;
  for (const auto& t : c.topology->triangle)
    for (std::size_t m = 0; m < 3; ++m) {
      const int i = t[m], j = t[(m + 1) % 3];
      const double stretch =
          (at(c.node, i) - at(c.node, j)).norm() - (at(rest, i) - at(rest, j)).norm();
      sum += 0.25 * stiffness * stretch * stretch;
    }
  return sum;
}

inline double plain_triangle_area(const std::vector<Vec3>& x, const std::array<int, 3>& t) {
  const double a = (at(x, t[0]) - at(x, t[1])).norm(), b = (at(x, t[1]) - at(x, t[2])).norm();
  const double c = (at(x, t[2]) - at(x, t[0])).norm(), s = (a + b + c) / 2;
  return std::sqrt(s * (s - a) * (s - b) * (s - c));  // Heron
}

inline double plain_area(const std::vector<Vec3>& x, const geometry::Topology& t) {
  double sum = 0;
  for (const auto& f : t.triangle) sum += plain_triangle_area(x, f);
  return sum;
}

inline double plain_volume(const std::vector<Vec3>& x, const geometry::Topology& t) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : x) middle += p / static_cast<double>(x.size());
  double sum = 0;
  for (const auto& f : t.triangle) {
    Mat3 m;
    m << at(x, f[0]) - middle, at(x, f[1]) - middle, at(x, f[2]) - middle;
    sum += m.determinant() / 6;
  }
  return sum;
}

inline double plain_area_energy(const PlainCell& c, double modulus) {
  const double a0 = plain_area(rest_nodes(c), *c.topology);
  const double a = plain_area(c.node, *c.topology);
  return modulus * (a - a0) * (a - a0) / (2 * a0);
}

inline double plain_local_area_energy(const PlainCell& c, double modulus) {
  const std::vector<Vec3> rest = rest_nodes(c);
  double sum = 0;
  for (const auto& f : c.topology->triangle) {
    const double a0 = plain_triangle_area(rest, f), a = plain_triangle_area(c.node, f);
    sum += modulus * (a - a0) * (a - a0) / (2 * a0);
  }
  return sum;
}

inline double plain_volume_energy(const PlainCell& c, double modulus) {
  const double v0 = 4.0 / 3 * kPi * c.radius * c.radius * c.radius;
  const double v = plain_volume(c.node, *c.topology);
  return modulus * (v * std::log(v / v0) - v + v0);
}

/// Angle between the outward normals of two triangles with a common edge, positive when convex.
inline double plain_hinge_angle(const std::vector<Vec3>& x, const std::array<int, 3>& f,
                                const std::array<int, 3>& g) {
  const auto normal = [&](const std::array<int, 3>& t) {
    return Vec3((at(x, t[1]) - at(x, t[0])).cross(at(x, t[2]) - at(x, t[0])).normalized());
  };
  const auto middle = [&](const std::array<int, 3>& t) {
    return Vec3((at(x, t[0]) + at(x, t[1]) + at(x, t[2])) / 3);
  };
  const Vec3 n = normal(f), m = normal(g);
  const double bend = (middle(g) - middle(f)).dot(m - n);
  return std::copysign(std::atan2(n.cross(m).norm(), n.dot(m)), bend);
}

inline double plain_bending_energy(const PlainCell& c, double stiffness) {
  const std::vector<Vec3> rest = rest_nodes(c);
  const auto& triangle = c.topology->triangle;
  double sum = 0;
  for (std::size_t f = 0; f < triangle.size(); ++f)
    for (std::size_t g = 0; g < f; ++g) {
      int shared = 0;
      for (int i : triangle[f])
        for (int j : triangle[g]) shared += i == j ? 1 : 0;
      if (shared != 2) continue;
      const double angle = plain_hinge_angle(c.node, triangle[f], triangle[g]);
      const double before = plain_hinge_angle(rest, triangle[f], triangle[g]);
      sum += stiffness * (1 - std::cos(angle - before));
    }
  return sum;
}

}  // namespace acinus::reference
