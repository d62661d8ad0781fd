#pragma once
/// Function of space whose zero is extracted, and the size of triangles by place.

#include <functional>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/vec.hpp"

namespace acinus::geometry {

/// Ball within which triangles must be smaller than the parts need.
struct FineBall {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
  double size = 0;             ///< um, as Shape::size
};

/// Function, negative inside, of parts each of which matters near itself only. Parts are passed in
/// ascending order; those left out are farther than their `reach` from the place.
struct Shape {
  /// Value at a place, um. @param parts  those that may matter
  std::function<double(const Vec3&, std::span<const int> parts)> value;
  /// Distance of one part alone, um; its slope is at most 1.
  std::function<double(const Vec3&, int part)> distance;
  std::vector<double> size;  ///< [part] um, longest edge of the tetrahedra that cut it
  std::vector<Box> box;      ///< [part] contains its surface
  /// [part] um, largest distance from its own surface at which a part may change that of others.
  std::vector<double> reach;
  std::vector<FineBall> fine;
};

}  // namespace acinus::geometry
