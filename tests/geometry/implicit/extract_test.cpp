#include "geometry/implicit/extract.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/parallel/threads.hpp"
#include "geometry/closed.hpp"
#include "geometry/euler.hpp"
#include "geometry/implicit/cavities.hpp"
#include "geometry/implicit/shape.hpp"
#include "geometry/implicit/zero_surface.hpp"
#include "geometry/measures.hpp"
#include "geometry/remesh.hpp"

namespace acinus::geometry {
namespace {

struct Ball {
  Vec3 center;
  double radius, size;
};

/// Union of bodies about these balls, each a part.
/// @param distance  um, to a part
Shape union_of(const std::vector<Ball>& ball, std::function<double(const Vec3&, int)> distance) {
  Shape shape;
  shape.distance = std::move(distance);
  shape.value = [distance = shape.distance](const Vec3& x, std::span<const int> parts) {
    double least = std::numeric_limits<double>::infinity();
    for (const int k : parts) least = std::min(least, distance(x, k));
    return least;
  };
  for (const Ball& b : ball) {
    shape.size.push_back(b.size);
    shape.box.push_back(sphere_box(b.center, b.radius));
    shape.reach.push_back(0);
  }
  return shape;
}

Shape balls(const std::vector<Ball>& ball) {
  return union_of(
      ball, [&ball](const Vec3& x, int k) { return (x - ball[k].center).norm() - ball[k].radius; });
}

constexpr std::size_t kMost = 10'000'000;

Vec3 draw_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vec3(x, y, z).normalized();
}

/// Two balls across a gap much narrower than the tetrahedra: joined as they come, apart when that
/// is asked for, with small triangles there only.
TEST(ExtractZero, BisectsEdgesThatMissAGap) {
  std::mt19937_64 random(7);
  int joined = 0;
  for (int k = 0; k < 40; ++k) {
    const Vec3 at(0.01 * k, 0.02 * k, -0.013 * k);
    const std::vector<Ball> two{{at, 1, 0.6}, {at + 2.05 * draw_direction(random), 1, 0.6}};
    const Shape shape = balls(two);
    const geometry::Surface plain = extract_zero(shape, kMost).surface;
    const bool is_joined = geometry::compute_connectivity(plain).parts == 1;
    joined += is_joined ? 1 : 0;
    const geometry::Surface apart = extract_zero(shape, kMost, [](ZeroSurface& z) {
                                      const geometry::Connectivity c =
                                          geometry::compute_connectivity(z.surface);
                                      return std::abs(c.parts - 2) + c.handles();
                                    }).surface;
    EXPECT_EQ(geometry::compute_connectivity(apart).parts, 2) << k;
    EXPECT_EQ(geometry::compute_connectivity(apart).euler_number, 4) << k;
    EXPECT_NO_THROW(geometry::check_manifold(apart, "two balls")) << k;
    EXPECT_LT(apart.triangle.size(), 6 * plain.triangle.size()) << k;
    if (!is_joined) {
      EXPECT_EQ(apart.triangle, plain.triangle) << k;
    }
  }
  EXPECT_GT(joined, 5);
}

/// No cracks between small and large tetrahedra, for any values beside them and any number of
/// threads.
TEST(ExtractZero, IsClosedWhereSizesDiffer) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < 10; ++k) {
    std::vector<Ball> ball;
    for (int i = 0; i < 60; ++i) {
      const double radius = std::exp2(-4 * uniform(random));
      const Vec3 center = 4 * std::cbrt(uniform(random)) * draw_direction(random);
      ball.push_back({center, radius, 0.9 * radius * (uniform(random) < 0.3 ? 0.25 : 1)});
    }
    const Shape shape = balls(ball);
    set_threads(1);
    const geometry::Surface s = extract_zero(shape, kMost).surface;
    EXPECT_NO_THROW(geometry::check_manifold(s, "balls")) << k;
    EXPECT_FALSE(geometry::crosses_itself(s)) << k;
    set_threads(2);
    EXPECT_EQ(extract_zero(shape, kMost).surface.triangle, s.triangle) << k;
  }
}

/// Cavities: a thick shell loses its inner wall, a ball beside it nothing.
TEST(LeaveOutCavities, KeepsWhatFacesOutward) {
  const std::vector<Ball> two{{Vec3::Zero(), 2, 0.4}, {Vec3(5, 0, 0), 1, 0.4}};
  const Shape shape = union_of(two, [&two](const Vec3& x, int k) {
    const double r = (x - two[k].center).norm();
    return k == 0 ? std::max(r - 2, 1 - r) : r - 1;
  });
  ZeroSurface z = extract_zero(shape, kMost);
  EXPECT_EQ(geometry::compute_connectivity(z.surface).parts, 3);
  remove_cavities(z);
  EXPECT_EQ(geometry::compute_connectivity(z.surface).parts, 2);
  EXPECT_EQ(z.edge.size(), z.surface.node.size());
  EXPECT_NO_THROW(geometry::check_manifold(z.surface, "shell and ball"));
  const double volume = geometry::compute_volume(z.surface.node, z.surface.triangle);
  EXPECT_NEAR(volume, 4 * kPi / 3 * 9, 0.03 * 4 * kPi / 3 * 9);
}

}  // namespace
}  // namespace acinus::geometry
