#include "contact/curved_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/topology.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using reference::kEps;

std::vector<Vec3> sphere_nodes(const geometry::Topology& t, double radius, double side) {
  std::vector<Vec3> node;
  for (const Vec3& x : t.rest) node.push_back(side * radius * x.normalized());
  return node;
}

TEST(CurvedTriangle, SphereGoesThroughItsCorners) {
  const std::array<Vec3, 3> corner = {Vec3(1, 2, 3), Vec3(4, 2.5, 3), Vec3(2, 5, 3.5)};
  const CurvedTriangle t = make_curved_triangle(corner, 0.1);
  EXPECT_EQ(t.curvature, 0.1);
  const FittedSphere s = fit_sphere(cap_of(t), 0.1);
  for (const Vec3& x : corner) {
    EXPECT_NEAR((x - s.center).norm(), 10.0, 32 * kEps * 10);
    EXPECT_NEAR((x - t.circumcenter).norm(), t.circumradius, 32 * kEps * 5);
  }
  EXPECT_LT((s.center - t.circumcenter).dot(t.normal), 0.0);  // on the inner side
}

// Sides 3, 4, 5: circumradius 2.5.
TEST(CurvedTriangle, CurvatureIsAtMostThatOfTheHemisphere) {
  const std::array<Vec3, 3> corner = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)};
  EXPECT_NEAR(make_curved_triangle(corner, 3.0).curvature, 0.4, 4 * kEps);
  EXPECT_NEAR(make_curved_triangle(corner, -3.0).curvature, -0.4, 4 * kEps);
  const CurvedTriangle t = make_curved_triangle(corner, 3.0);
  // A height is the root of a difference: half the digits.
  EXPECT_NEAR((fit_sphere(cap_of(t), t.curvature).center - Vec3(1.5, 2, 0)).norm(), 0.0, 1e-7);
}

// On a sphere the operator is exact up to the shape of the triangles: an error of the order of
// (edge/R)^2 = 0.09 times their deviation from one another (0.18 in length, near the corners of the
// icosahedron), at most 1.6 %; the mean over the surface better.
TEST(CurvedTriangle, CurvatureOfASphereAndOfAHollow) {
  for (const int n : {162, 642}) {
    const geometry::Topology& topology = geometry::shared_icosphere(n);
    const auto node = sphere_nodes(topology, 12.0, 1.0);
    const auto curved = make_curved_triangles(node, topology.triangle);
    double mean = 0, worst = 0;
    for (const CurvedTriangle& t : curved) {
      mean += t.curvature * 12.0 / topology.n_triangle;
      worst = std::max(worst, std::abs(t.curvature * 12.0 - 1));
    }
    std::printf("curvature of an icosphere, %d nodes: mean %.5f, worst %.1e\n", n, mean, worst);
    EXPECT_NEAR(mean, 1.0, 1e-3);
    EXPECT_LT(worst, 1e-2);
    // The same surface with its inside out.
    auto inward = topology.triangle;
    for (auto& t : inward) std::swap(t[1], t[2]);
    const auto hollow = make_curved_triangles(node, inward);
    for (int k = 0; k < topology.n_triangle; ++k)
      EXPECT_NEAR(hollow[k].curvature, -curved[k].curvature, 64 * kEps);
  }
}

// The operator that is averaged: a node inside a flat face has no curvature.
TEST(CurvedTriangle, FlatPartsHaveNone) {
  const std::vector<Vec3> node = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}, {2, 2, 0}};
  const std::vector<std::array<int, 3>> triangle = {{0, 4, 1}, {1, 4, 2}, {2, 4, 0},
                                                    {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const geometry::MeanCurvature h = geometry::compute_mean_curvature(node, triangle);
  EXPECT_NEAR(h.normal[4].norm(), 0.0, 16 * kEps);
}

}  // namespace
}  // namespace acinus::contact
