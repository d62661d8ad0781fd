#include "contact/closest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "geometry/closest_point.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using reference::kEps;

/// Bumpy sphere with a few triangles compressed flat.
struct Bumpy {
  std::vector<std::array<int, 3>> triangle;
  SurfaceBody body;

  explicit Bumpy(UniformStream& random) {
    const geometry::Topology& t = geometry::shared_icosphere(162);
    triangle = t.triangle;
    body.triangle = &triangle;
    for (const Vec3& x : t.rest)
      body.node.push_back(10 * x + reference::random_vector(random, 0.3));
    for (const std::size_t k : {0, 100, 250}) {
      auto corner = [&](std::size_t m) -> Vec3& { return body.node[triangle[k][m]]; };
      corner(2) = 0.5 * (corner(0) + corner(1));
    }
    refresh_body(body);
  }
  Bumpy(const Bumpy&) = delete;

  geometry::ClosestPoint closest_on(int t, const Vec3& x) const {
    const auto& corner = triangle[t];
    return geometry::find_closest_point(x, body.node[corner[0]], body.node[corner[1]],
                                        body.node[corner[2]]);
  }
};

Vec3 point_of(const PointBlock& block, int i) {
  return {block.x[3 * i], block.x[3 * i + 1], block.x[3 * i + 2]};
}

/// Block of n points near the surface, some right on its corners and edges, and every triangle a
/// candidate of each, the likeliest first.
struct Question {
  std::vector<int> triangle;
  std::vector<float> bound;
  PointBlock block;

  Question(const Bumpy& b, int n, UniformStream& random) {
    const int n_triangle = static_cast<int>(b.triangle.size());
    block.n = n;
    for (int i = 0; i < n; ++i) {
      const auto k = i % 8 == 1 ? 0 : static_cast<std::size_t>(random.uniform(0, 320));
      const Vec3& u = b.body.node[b.triangle[k][0]];
      const Vec3& v = b.body.node[b.triangle[k][1]];
      const Vec3 x = i % 4 == 0   ? u
                     : i % 4 == 1 ? Vec3(0.5 * (u + v))
                                  : Vec3(b.body.center[k] * random.uniform(0.85, 1.2));
      for (int m = 0; m < 3; ++m) block.x[3 * i + m] = x[m];
      block.begin[i] = static_cast<std::uint32_t>(triangle.size());
      std::vector<int> order(n_triangle);
      std::iota(order.begin(), order.end(), 0);
      for (std::size_t at = order.size() - 1; at > 0; --at)
        std::swap(order[at], order[random.uniform(0, 1) * static_cast<double>(at)]);
      // A guess that is often right, and bounds that are too low by up to the shift.
      std::swap(*std::ranges::find(order, static_cast<int>(k)), order[0]);
      for (const int t : order) {
        triangle.push_back(t);
        bound.push_back(static_cast<float>(std::sqrt(b.closest_on(t, x).squared_distance) -
                                           random.uniform(0, 0.3)));
      }
      block.end[i] = static_cast<std::uint32_t>(triangle.size());
    }
  }
};

TEST(FindClosest, IsTheFirstOfTheClosestOfAllTriangles) {
  auto random = reference::stream(73);
  const Bumpy b(random);
  int ties = 0, on_sliver = 0, nothing = 0;
  for (const int n : {0, 1, 7, 8, 9, 63, PointBlock::kSize}) {
    Question q(b, n, random);
    constexpr double kHorizon = 1.2;
    find_closest(b.body, {q.triangle, q.bound}, 0.3 + kRounding, kHorizon, q.block);
    for (int i = 0; i < n; ++i) {
      const Vec3 x = point_of(q.block, i);
      int best = -1;
      double squared = kHorizon * kHorizon;
      int same = 0;
      for (int t = 0; t < static_cast<int>(b.triangle.size()); ++t) {
        const double here = b.closest_on(t, x).squared_distance;
        same = here < squared ? 0 : same + (here == squared ? 1 : 0);
        if (here < squared) best = t;
        squared = std::min(squared, here);
      }
      const std::size_t k = i;
      ASSERT_EQ(q.block.triangle[k], best) << "point " << i << " of " << n;
      EXPECT_EQ(q.block.squared[k], squared);
      if (best < 0) {
        ++nothing;
        continue;
      }
      ties += same > 0 ? 1 : 0;
      on_sliver += best == 0 || best == 100 || best == 250 ? 1 : 0;
      const geometry::ClosestPoint twin = b.closest_on(best, x);
      EXPECT_EQ(q.block.weight_b[k], twin.weight[1]);
      EXPECT_EQ(q.block.weight_c[k], twin.weight[2]);
      EXPECT_EQ(q.block.rounded[1][k], static_cast<float>(twin.weight[1]));
    }
  }
  std::printf("find_closest: %d ties, %d on slivers, %d beyond the horizon\n", ties, on_sliver,
              nothing);
  EXPECT_GT(ties, 20);
  EXPECT_GT(on_sliver, 0);
  EXPECT_GT(nothing, 5);
}

TEST(FindClosest, WritesTheDistancesThatMayMatter) {
  auto random = reference::stream(74);
  const Bumpy b(random);
  Question q(b, 20, random);
  constexpr double kShift = 0.9;
  std::vector<float> distance(q.triangle.size(), -1);
  find_closest(b.body, {q.triangle, q.bound}, kShift, 1e150, q.block, distance);
  int written = 0;
  for (int i = 0; i < 20; ++i)
    for (std::uint32_t k = q.block.begin[i]; k < q.block.end[i]; ++k) {
      const double exact =
          std::sqrt(b.closest_on(q.triangle[k], point_of(q.block, i)).squared_distance);
      const double least = std::sqrt(q.block.squared[i]);
      if (distance[k] >= 0) {
        EXPECT_EQ(distance[k], static_cast<float>(exact));
        ++written;
      } else {
        EXPECT_GT(exact, least + kShift);
      }
    }
  EXPECT_GT(written, 100);
  EXPECT_LT(written, static_cast<int>(q.triangle.size()) / 2);
}

TEST(ComputeGaps, PointFromThePlaceToThePoint) {
  auto random = reference::stream(75);
  const Bumpy b(random);
  double worst_normal = 0;
  for (const Place place : {Place::kRounded, Place::kExact})
    for (const int n : {1, 9, PointBlock::kSize}) {
      Question q(b, n, random);
      find_closest(b.body, {q.triangle, q.bound}, 0.3 + kRounding, 1e150, q.block);
      compute_gaps(b.body, place, q.block);
      for (int i = 0; i < n; ++i) {
        const std::size_t k = i;
        const auto& corner = b.triangle[q.block.triangle[k]];
        Vec3 at = Vec3::Zero(), outward = Vec3::Zero();
        const double r0 = static_cast<double>(q.block.rounded[0][k]),
                     r1 = static_cast<double>(q.block.rounded[1][k]);
        const Vec3 rounded(r0, r1, 1 - r0 - r1);
        const Vec3 exact(1 - q.block.weight_b[k] - q.block.weight_c[k], q.block.weight_b[k],
                         q.block.weight_c[k]);
        for (int m = 0; m < 3; ++m) {
          const std::size_t c = corner[m];
          at += (place == Place::kExact ? exact : rounded)[m] * b.body.node[c];
          outward += rounded[m] * b.body.node_normal[c];
        }
        outward.normalize();
        const Vec3 found(q.block.outward[0][k], q.block.outward[1][k], q.block.outward[2][k]);
        const Vec3 normal(q.block.normal[0][k], q.block.normal[1][k], q.block.normal[2][k]);
        worst_normal = std::max(worst_normal, (found - outward).norm());
        const Vec3 x = point_of(q.block, i);
        EXPECT_NEAR(normal.norm(), 1, 8 * kEps);
        // places are sums of numbers up to 10 um
        const double tolerance = 64 * kEps * 10;
        if (std::abs(q.block.gap[k]) > 1e-6) {
          EXPECT_LT((at + q.block.gap[k] * normal - x).norm(), tolerance);
          EXPECT_EQ(q.block.gap[k] > 0, (x - at).dot(outward) > 0);
        } else {  // no direction there: the normal of the surface
          EXPECT_LT((at - x).norm(), 1e-6 + tolerance);
          EXPECT_EQ(normal, found);
        }
      }
    }
  std::printf("compute_gaps: worst difference of outward normals %.1e\n", worst_normal);
  EXPECT_LT(worst_normal, 64 * kEps);
}

}  // namespace
}  // namespace acinus::contact
