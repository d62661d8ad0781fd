#include "geometry/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/geometry/shapes.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

using reference::kEps;

TEST(Measures, BoxHasItsHandValues) {
  Surface box = make_box(Vec3(1, 2, 3));
  for (Vec3& x : box.node) x += Vec3(100, -200, 300);
  EXPECT_NEAR(compute_volume(box.node, box.triangle), 6, 300 * 12 * kEps * 6);
  EXPECT_NEAR(compute_area(box.node, box.triangle), 22, 300 * 12 * kEps * 22);
  EXPECT_LT((compute_centroid(box.node, box.triangle) - Vec3(100.5, -199, 301.5)).norm(), 1e-12);
}

TEST(Measures, VolumeAndAreaConvergeAtSecondOrder) {
  double last_volume = 0, last_area = 0;
  for (const int n_node : {162, 642, 2562}) {
    const Surface sphere = make_sphere(n_node, 1);
    const double volume = 4 * kPi / 3 - compute_volume(sphere.node, sphere.triangle);
    const double area = 4 * kPi - compute_area(sphere.node, sphere.triangle);
    if (last_volume > 0) {
      EXPECT_NEAR(std::log2(last_volume / volume), 2, 0.05);
      EXPECT_NEAR(std::log2(last_area / area), 2, 0.05);
    }
    last_volume = volume;
    last_area = area;
  }
}

TEST(MeanCurvature, IsOneOverRadiusOnASphere) {
  const Surface sphere = make_sphere(162, 12, Vec3(40, 50, 60));
  const MeanCurvature curvature = compute_mean_curvature(sphere.node, sphere.triangle);
  double mean = 0, area = 0, worst = 0;
  for (std::size_t i = 0; i < sphere.node.size(); ++i) {
    const Vec3 outward = (sphere.node[i] - Vec3(40, 50, 60)) / 12;
    const double radius = 1 / curvature.normal[i].dot(outward);
    mean += 1 / curvature.normal[i].norm() / 162;
    worst = std::max(worst, std::abs(radius / 12 - 1));
    area += curvature.mixed_area[i];
    EXPECT_LT(curvature.normal[i].cross(outward).norm() * 12, 0.02);  // rings are irregular
  }
  std::printf("mean 1/H %.4f um, worst node %.2e\n", mean, worst);
  EXPECT_NEAR(mean, 11.9993, 5e-5);
  // On a sphere (x_i - x_j).n = |x_i - x_j|^2 / 2R, so the Voronoi areas cancel: exact without
  // obtuse triangles. Only the direction errs, which makes |H| a little larger.
  EXPECT_LT(worst, 1e-12);
  EXPECT_NEAR(area, compute_area(sphere.node, sphere.triangle), 1e-10);
}

TEST(MeanCurvature, MixedAreasSumToTheSurfaceWithObtuseTriangles) {
  Surface shape = make_sphere(162, 1);
  for (Vec3& x : shape.node) x.z() *= 4;
  const MeanCurvature curvature = compute_mean_curvature(shape.node, shape.triangle);
  double area = 0;
  for (const double a : curvature.mixed_area) {
    EXPECT_GT(a, 0);
    area += a;
  }
  EXPECT_NEAR(area, compute_area(shape.node, shape.triangle), 1e-12);
}

TEST(MeanCurvature, IsTheGradientOfTheArea) {  // dA/dx_i = 2 A_i H n, exactly, for any mesh
  Surface shape = make_sphere(42, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for (Vec3& x : shape.node) x += Vec3(uniform(random), uniform(random), uniform(random));
  const MeanCurvature curvature = compute_mean_curvature(shape.node, shape.triangle);
  for (std::size_t i = 0; i < shape.node.size(); ++i) {
    for (int d = 0; d < 3; ++d) {
      const double h = 1e-5, x = shape.node[i][d];
      shape.node[i][d] = x + h;
      const double plus = compute_area(shape.node, shape.triangle);
      shape.node[i][d] = x - h;
      const double minus = compute_area(shape.node, shape.triangle);
      shape.node[i][d] = x;
      // h^2 A''' + eps A / h = 1e-10 * O(10) + 3e-10
      EXPECT_NEAR((plus - minus) / (2 * h), 2 * curvature.mixed_area[i] * curvature.normal[i][d],
                  3e-9);
    }
  }
}

void expect_closest(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const ClosestPoint found = find_closest_point(p, a, b, c);
  EXPECT_NEAR(found.weight.sum(), 1, 8 * kEps);
  EXPECT_GE(found.weight.minCoeff(), -8 * kEps);
  EXPECT_LE(found.weight.maxCoeff(), 1 + 8 * kEps);
  EXPECT_LT(
      (found.point - (found.weight[0] * a + found.weight[1] * b + found.weight[2] * c)).norm(),
      1e-12);
  EXPECT_NEAR(found.squared_distance, (p - found.point).squaredNorm(), 1e-13);
  // The distance is convex in the weights: no step to a corner may make it smaller.
  for (const Vec3& corner : {a, b, c}) {
    EXPECT_LE((p - found.point).dot(corner - found.point), 1e-12);
  }
}

TEST(ClosestPoint, SatisfiesTheOptimalityConditions) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const auto draw = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  int inside = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vec3 a = draw(), b = draw(), c = draw(), p = draw();
    expect_closest(p, a, b, c);
    inside += find_closest_point(p, a, b, c).weight.minCoeff() > 0;
  }
  EXPECT_GT(inside, 1000);
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  EXPECT_LT((find_closest_point(Vec3(0.5, 0.5, 3), a, b, c).weight - Vec3(0.5, 0.25, 0.25)).norm(),
            1e-15);
  EXPECT_EQ(find_closest_point(Vec3(-1, -1, 0), a, b, c).weight, Vec3(1, 0, 0));
  EXPECT_EQ(find_closest_point(Vec3(1, -1, 0), a, b, c).weight, Vec3(0.5, 0.5, 0));
  EXPECT_EQ(find_closest_point(Vec3(2, 2, 1), a, b, c).weight, Vec3(0, 0.5, 0.5));
}

TEST(ClosestPoint, TakesDegenerateTriangles) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0);
  for (const Vec3& p : {Vec3(2, 1, 0), Vec3(-1, 0, 0), Vec3(9, 1, 1), Vec3(0.5, 0, 0)}) {
    expect_closest(p, a, b, c);
    expect_closest(p, c, a, b);
    expect_closest(p, a, a, c);
    expect_closest(p, b, b, b);
  }
}

TEST(TriangleQuality, IsOneForEquilateralAndZeroForALine) {
  const Vec3 a(0, 0, 0), b(1, 0, 0);
  EXPECT_NEAR(compute_triangle_quality(a, b, Vec3(0.5, std::sqrt(3.0) / 2, 0)), 1, 4 * kEps);
  EXPECT_EQ(compute_triangle_quality(a, b, Vec3(2, 0, 0)), 0);
  EXPECT_EQ(compute_triangle_quality(a, a, a), 0);
  EXPECT_NEAR(compute_triangle_quality(a, b, Vec3(0, 1, 0)), std::sqrt(3.0) / 2, 4 * kEps);
  const Topology& mesh = shared_icosphere(12);
  EXPECT_NEAR(compute_quality(mesh.rest, mesh.triangle), 1, 1e-14);
}

TEST(WindingNumber, TellsInsideFromOutside) {
  const Surface torus = make_torus(24);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-4.5, 4.5);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 p(uniform(random), uniform(random), uniform(random) / 3);
    const double ring = std::hypot(p.x(), p.y()) - 3;
    const double depth = 1 - std::hypot(ring, p.z());
    if (std::abs(depth) < 0.1) continue;  // facets cut up to 0.05
    EXPECT_NEAR(compute_winding_number(p, torus.node, torus.triangle), depth > 0 ? 1 : 0, 1e-12);
    EXPECT_EQ(is_inside(p, torus.node, torus.triangle), depth > 0);
  }
  const Surface box = make_box(Vec3(1, 1, 1));
  EXPECT_TRUE(is_inside(Vec3(1e-9, 0.5, 0.5), box.node, box.triangle));
  EXPECT_FALSE(is_inside(Vec3(-1e-9, 0.5, 0.5), box.node, box.triangle));
}

}  // namespace
}  // namespace acinus::geometry
