#include "geometry/star.hpp"

#include <gtest/gtest.h>

#include "geometry/inner_ball.hpp"
#include "geometry/measures.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/reference/plain_surface.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

/// L of two boxes, depth 1: from (0,0) over (3,0), (3,1), (1,1), (1,3) to (0,3).
Surface make_corner() {
  const std::array<std::array<double, 2>, 6> outline = {
      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}};
  Surface out;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) out.node.emplace_back(x, y, z);
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    out.triangle.push_back({a, c, b});
    out.triangle.push_back({6 + a, 6 + b, 6 + c});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    out.triangle.push_back({k, next, 6 + next});
    out.triangle.push_back({k, 6 + next, 6 + k});
  }
  return out;
}

TEST(Star, MarginIsTheDistanceFromTheNearestFacePlane) {
  const Surface box = make_box(Vec3(1, 2, 3));
  EXPECT_NEAR(compute_star_margin(box, Vec3(0.3, 1, 1)), 0.3, 1e-15);
  EXPECT_NEAR(compute_star_margin(box, Vec3(0.5, 2.25, 1)), -0.25, 1e-15);
  const Surface corner = make_corner();  // the planes x = 1 and y = 1 bound its kernel
  EXPECT_NEAR(compute_star_margin(corner, Vec3(0.6, 0.7, 0.5)), 0.3, 1e-15);
  EXPECT_NEAR(compute_star_margin(corner, Vec3(2, 0.5, 0.5)), -1, 1e-15);
}

TEST(Star, CentreIsTheCentroidOrAnyPointOfTheKernel) {
  const Surface box = make_box(Vec3(1, 2, 3));
  EXPECT_EQ(find_star_center(box), compute_centroid(box.node, box.triangle));
  const Surface corner = make_corner();  // its centroid (1.1, 1.1, 0.5) sees not all
  EXPECT_LT(compute_star_margin(corner, compute_centroid(corner.node, corner.triangle)), 0);
  const auto center = find_star_center(corner);
  ASSERT_TRUE(center);
  EXPECT_GT(compute_star_margin(corner, *center), 0.1);  // a tenth of the volume radius 1.06
  const Surface torus = make_torus(12);
  EXPECT_FALSE(find_star_center(torus));
}

TEST(Star, RaysMeetTheSurfaceAlsoThroughNodesAndEdges) {
  Surface shape = make_sphere(162, 1);
  for (Vec3& x : shape.node) x = x.cwiseProduct(Vec3(1, 2, 3)) + Vec3(50, 60, 70);
  const Vec3 center(50.1, 60.2, 69.8);
  const StarSurface star(shape, center);
  const int last = static_cast<int>(shape.triangle.size()) - 1;
  // 16 ulp of the coordinates, which grazing rays enlarge by less than the ratio of the axes.
  const double tolerance = 16 * 3 * 100 * reference::kEps;
  for (const int start : {0, last}) {
    for (const Vec3& x : shape.node)
      EXPECT_LT((star.cast(x - center, start).point - x).norm(), tolerance);
    for (const auto& [a, b, c] : shape.triangle)
      for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        const Vec3 middle = (shape.node[i] + shape.node[j]) / 2;
        EXPECT_LT((star.cast(middle - center, start).point - middle).norm(), tolerance);
      }
  }
}

TEST(Star, HitsLieOnTheirTriangleAndTheRay) {
  UniformStream random = reference::stream(1);
  const Surface corner = make_corner();
  const Vec3 center(0.4, 0.5, 0.6);
  const StarSurface star(corner, center);
  int start = 0;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 direction = random.unit_vector();
    const Hit hit = star.cast(3 * direction, start);
    start = hit.triangle;
    const auto& [a, b, c] = corner.triangle[hit.triangle];
    EXPECT_LT(reference::plain_distance_to_triangle(hit.point, corner.node[a], corner.node[b],
                                                    corner.node[c]),
              1e-13);
    EXPECT_LT((hit.point - center).normalized().cross(direction).norm(), 1e-13);
    EXPECT_GT((hit.point - center).dot(direction), 0.39);
  }
}

TEST(InnerBall, IsTheLargestBallInside) {
  const Surface box = make_box(Vec3(1, 2, 3));
  EXPECT_NEAR(find_inner_ball(box).radius, 0.5, 0.05 * 1.13);  // volume radius of 6 um^3
  const Surface corner = make_corner();                        // limited by its depth
  const InnerBall ball = find_inner_ball(corner);
  EXPECT_NEAR(ball.radius, 0.5, 0.05 * 1.07);
  EXPECT_TRUE(is_inside(ball.center, corner.node, corner.triangle));
  const Surface torus = make_torus(24);  // tube of radius 1; facets cost 1 - cos(pi / 24)
  const InnerBall tube = find_inner_ball(torus);
  EXPECT_NEAR(tube.radius, 1, 0.05 * 2.42 + 0.03);
  EXPECT_NEAR(-reference::plain_signed_distance(tube.center, torus.node, torus.triangle),
              tube.radius, 1e-12);
  Surface inside_out = box;
  for (auto& t : inside_out.triangle) std::swap(t[0], t[1]);
  EXPECT_EQ(find_inner_ball(inside_out).radius, 0);
}

}  // namespace
}  // namespace acinus::geometry
