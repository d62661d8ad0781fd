#include "coupling/measure/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace acinus::coupling {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Points without any symmetry.
std::vector<Vec3> some_points() {
  return {{0, 0, 0}, {10, 1, 0}, {2, 20, -3}, {-4, 5, 30}, {7, -8, 9}};
}

Mat3 some_turn() { return Eigen::AngleAxisd(2.5, Vec3(1, -2, 3).normalized()).toRotationMatrix(); }

TEST(RelativeError, IsRmsOfDifferenceOverRmsOfReference) {
  // Differences 3 and 4: sqrt(25); references 6 and 8: sqrt(100).
  EXPECT_DOUBLE_EQ(relative_error(std::vector{9.0, 4.0}, std::vector{6.0, 8.0}), 0.5);
}

TEST(RelativeError, DoesNotDependOnTheUnit) {
  const std::vector<double> a{1, 2, 3}, b{1.1, 1.9, 3.3};
  std::vector<double> small_a = a, small_b = b;
  for (double& x : small_a) x *= 0x1p-60;
  for (double& x : small_b) x *= 0x1p-60;
  EXPECT_DOUBLE_EQ(relative_error(a, b), relative_error(small_a, small_b));
}

TEST(RelativeError, OfEqualValuesIsZeroAndOfNothingToCompareWithIsNot) {
  EXPECT_EQ(relative_error(std::vector{1.0, -2.0}, std::vector{1.0, -2.0}), 0);
  EXPECT_EQ(relative_error(std::vector{0.0}, std::vector{0.0}), 0);
  EXPECT_TRUE(std::isinf(relative_error(std::vector{1.0}, std::vector{0.0})));
  EXPECT_TRUE(std::isnan(relative_error(std::vector{std::nan("")}, std::vector{1.0})));
}

TEST(AlignedDistance, ForgetsRigidMotion) {
  const std::vector<Vec3> reference = some_points();
  std::vector<Vec3> moved;
  for (const Vec3& x : reference) moved.push_back(some_turn() * x + Vec3(100, -200, 300));
  const Distance d = aligned_distance(moved, reference);
  // Some tens of operations on coordinates of a few hundred um.
  EXPECT_LT(d.max, 64 * kEps * 400);
  EXPECT_LE(d.rms, d.max);
}

TEST(AlignedDistance, SeesAReflection) {
  const std::vector<Vec3> reference = some_points();
  std::vector<Vec3> mirrored;
  for (const Vec3& x : reference) mirrored.emplace_back(-x.x(), x.y(), x.z());
  EXPECT_GT(aligned_distance(mirrored, reference).rms, 1);
}

TEST(AlignedDistance, KeepsADeformation) {
  // A square stretched to a rectangle: each corner is half the stretch away, however it is turned.
  const std::vector<Vec3> reference{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  std::vector<Vec3> stretched;
  for (const Vec3& x : reference)
    stretched.push_back(some_turn() * Vec3(1.25 * x.x(), x.y(), x.z()) + Vec3(5, 6, 7));
  const Distance d = aligned_distance(stretched, reference);
  EXPECT_NEAR(d.max, 0.25, 64 * kEps * 10);
  EXPECT_NEAR(d.rms, 0.25, 64 * kEps * 10);
}

TEST(AlignedDistance, TellsTheFarthestFromTheTypical) {
  // Three of four points of a large tetrahedron fit nearly, the fourth is 1 um off outward: the
  // best fit moves all by a quarter of that, so 3/4 and 1/4 um are left, to (1/1000)^2.
  std::vector<Vec3> reference{
      {1e3, 1e3, 1e3}, {1e3, -1e3, -1e3}, {-1e3, 1e3, -1e3}, {-1e3, -1e3, 1e3}};
  std::vector<Vec3> point = reference;
  point[0] += Vec3(1, 1, 1).normalized();
  const Distance d = aligned_distance(point, reference);
  EXPECT_NEAR(d.max, 0.75, 1e-3);
  EXPECT_NEAR(d.rms, std::sqrt((0.75 * 0.75 + 3 * 0.25 * 0.25) / 4), 1e-3);
}

TEST(AlignedDistance, OfOnePointIsZero) {
  const Distance d = aligned_distance(std::vector{Vec3(1, 2, 3)}, std::vector{Vec3(-4, 5, 6)});
  EXPECT_EQ(d.max, 0);
  EXPECT_EQ(d.rms, 0);
}

}  // namespace
}  // namespace acinus::coupling
