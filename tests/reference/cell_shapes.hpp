#pragma once
/// Shapes that a dividing cell may have, all with the mesh of an icosphere and the same volume.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "geometry/measures.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::reference {

struct CellShape {
  std::string name;
  std::function<Vec3(const Vec3&)> place;  ///< of a direction
  bool always_splits = true;               ///< into star-shaped halves, by nearly any plane
};

inline std::vector<CellShape> cell_shapes() {
  const auto stretch = [](const Vec3& axes) {
    return [axes](const Vec3& d) -> Vec3 { return d.cwiseProduct(axes); };
  };
  const auto dented = [](const Vec3& d) -> Vec3 {
    const double angle = std::acos(d.z());
    return (1 - 0.35 * std::exp(-angle * angle / 0.36)) * d;
  };
  // A spindle wound round the z axis over twice the angle given.
  const auto bent = [](double angle, double radius, double thickness) {
    return [=](const Vec3& d) -> Vec3 {
      const double a = angle * d.x(), r = radius + thickness * d.y();
      return {r * std::sin(a), r * std::cos(a), thickness * d.z()};
    };
  };
  // Twelve faces at equal distance, softened: the cell of a dense packing.
  const auto packed = [](const Vec3& d) -> Vec3 {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const double height = (d[axis] + sign * d[(axis + 1) % 3]) / std::sqrt(2.0);
        sum += std::pow(std::abs(height), 24);
      }
    return std::pow(sum, -1.0 / 24) * d;
  };
  return {{"sphere", stretch({1, 1, 1}), true},
          {"ellipsoid 2:1", stretch({1, 1, 2}), true},
          {"pancake 4:1", stretch({4, 4, 1}), true},
          {"packed", packed, true},
          {"dented", dented, true},
          {"crescent", bent(1.4, 1.6, 0.75), true},
          {"horseshoe", bent(2.4, 1.2, 0.5), false}};
}

/// Shape with the volume of the inflated sphere of this radius, its mesh turned beforehand.
inline geometry::Surface make_cell(const CellShape& shape, const geometry::Topology& topology,
                                   double radius, const Mat3& rotation, const Vec3& center) {
  geometry::Surface out;
  out.triangle = topology.triangle;
  for (const Vec3& rest : topology.rest)
    out.node.push_back(shape.place((rotation * rest).normalized()));
  const double volume = geometry::compute_volume(out.node, out.triangle);
  const double scale = radius * std::cbrt(4 * kPi / 3 / volume);
  for (Vec3& x : out.node) x = center + scale * x;
  return out;
}

}  // namespace acinus::reference
