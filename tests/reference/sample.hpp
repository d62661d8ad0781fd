#pragma once
/// Small things that many tests need: rotations, random vectors, the unit of round-off.

#include <limits>

#include "core/numbers/random.hpp"
#include "core/vec.hpp"

namespace acinus::reference {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Random numbers of one test.
inline UniformStream stream(std::uint64_t test) { return UniformStream(20, Purpose::kTest, test); }

/// Three normal numbers. Arguments of one call would be drawn in an order that each compiler
/// chooses.
inline Vec3 normal_vector(UniformStream& random) {
  const double z = random.normal(), y = random.normal();
  return {random.normal(), y, z};
}

/// Uniform over all rotations.
inline Mat3 random_rotation(UniformStream& random) {
  const Vec3 v = normal_vector(random);
  return Eigen::Quaterniond(random.normal(), v.x(), v.y(), v.z()).normalized().toRotationMatrix();
}

inline Vec3 random_vector(UniformStream& random, double half_width) {
  const double x = random.uniform(-half_width, half_width),
               y = random.uniform(-half_width, half_width);
  return {x, y, random.uniform(-half_width, half_width)};
}

inline Mat3 random_matrix(UniformStream& random, double half_width) {
  Mat3 m;
  for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = random.uniform(-half_width, half_width);
  return m;
}

}  // namespace acinus::reference
