#pragma once
/// Function of space whose zero is looked for, and how small triangles must be where.

#include <functional>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/vec.hpp"

namespace acinus::geometry {

/// A place where triangles must be smaller than its parts ask for.
struct FineBall {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
  double size = 0;             ///< um, as Shape::size
};

/// A function, negative inside, put together from parts each of which matters near itself only.
/// Parts are given in ascending order; those left out are farther than their `reach` from the
/// place.
struct Shape {
  /// um. @param parts  those that may matter
  std::function<double(const Vec3&, std::span<const int> parts)> value;
  /// um, of one part alone: never changes by more than the place moves.
  std::function<double(const Vec3&, int part)> distance;
  std::vector<double> size;  ///< [part] um, longest edge of the tetrahedra that cut it
  std::vector<Box> box;      ///< [part] that holds its surface
  /// [part] um, how far from its own surface a part may change that of others.
  std::vector<double> reach;
  std::vector<FineBall> fine;
};

}  // namespace acinus::geometry
