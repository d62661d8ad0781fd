#include "geometry/closest_point_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <vector>

#include "geometry/closest_point.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

/// Point, then the corners of a triangle.
using Case = std::array<Vec3, 4>;

struct Answer {
  double weight_b, weight_c, squared_distance;
  bool sliver;
  bool operator==(const Answer&) const = default;
};

/// All cases in lanes, eight unlike ones at a time; the last eight are filled up with the first.
std::vector<Answer> answers_of(const std::vector<Case>& cases) {
  std::vector<Answer> out;
  for (std::size_t first = 0; first < cases.size(); first += kLanes) {
    std::array<Lane3, 4> x;
    for (int l = 0; l < kLanes; ++l) {
      const Case& c = cases[(first + static_cast<std::size_t>(l)) % cases.size()];
      for (std::size_t m = 0; m < 4; ++m) {
        x[m].x[l] = c[m].x();
        x[m].y[l] = c[m].y();
        x[m].z[l] = c[m].z();
      }
    }
    const ClosestPointLanes found = find_closest_point_lanes(x[0], x[1], x[2], x[3]);
    for (int l = 0; l < kLanes && out.size() < cases.size(); ++l)
      out.push_back(
          {found.weight_b[l], found.weight_c[l], found.squared_distance[l], found.sliver[l] != 0});
  }
  return out;
}

/// Compares with the twin, bit by bit; slivers are the twin's alone. Returns how many were slivers.
int expect_same(const std::vector<Case>& cases) {
  const std::vector<Answer> answers = answers_of(cases);
  int slivers = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& [p, a, b, c] = cases[k];
    if (answers[k].sliver) {
      ++slivers;
      const Vec3 ab = b - a, ac = c - a;
      EXPECT_LE(ab.cross(ac).norm(), 2e-6 * std::max({ab.squaredNorm(), ac.squaredNorm()}));
      continue;
    }
    const ClosestPoint twin = find_closest_point(p, a, b, c);
    EXPECT_EQ(answers[k].weight_b, twin.weight[1]) << k;
    EXPECT_EQ(answers[k].weight_c, twin.weight[2]) << k;
    EXPECT_EQ(answers[k].squared_distance, twin.squared_distance) << k;
  }
  return slivers;
}

TEST(ClosestPointLanes, AreTheScalarTwinBitForBit) {
  auto random = reference::stream(71);
  std::vector<Case> cases;
  for (int k = 0; k < 20000; ++k) {
    Case c;
    for (Vec3& x : c) x = reference::random_vector(random, 2);
    cases.push_back(c);
    c[0] *= 1e6;  // far away
    cases.push_back(c);
    for (Vec3& x : c) x += Vec3(1e3, -2e3, 5e2);  // far from the origin
    cases.push_back(c);
  }
  EXPECT_EQ(expect_same(cases), 0);

  int inside = 0, on_edge = 0, at_corner = 0;
  for (const Answer& a : answers_of(cases)) {
    const double rest = 1 - a.weight_b - a.weight_c;
    const int zeros = (a.weight_b == 0 ? 1 : 0) + (a.weight_c == 0 ? 1 : 0) + (rest == 0 ? 1 : 0);
    ++(zeros == 0 ? inside : zeros == 1 ? on_edge : at_corner);
  }
  std::printf("closest point lanes: %d on faces, %d on edges, %d on corners\n", inside, on_edge,
              at_corner);
  for (const int n : {inside, on_edge, at_corner}) EXPECT_GT(n, 1000);
}

// Small whole numbers put points exactly on corners, edges, faces and the borders of their regions.
TEST(ClosestPointLanes, AreTheTwinOnTheBordersOfRegions) {
  std::vector<Case> cases;
  const std::vector<std::array<Vec3, 3>> triangles{
      {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)},    // right angles
      {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 1, 0)},    // obtuse at c
      {Vec3(2, 1, 0), Vec3(0, 0, 0), Vec3(4, 0, 0)},    // at a
      {Vec3(4, 0, 0), Vec3(2, 1, 0), Vec3(0, 0, 0)},    // at b
      {Vec3(0, 0, 1), Vec3(1, 3, 0), Vec3(-2, 1, -1)},  // oblique
  };
  for (const auto& [a, b, c] : triangles)
    for (int x = -6; x <= 10; ++x)
      for (int y = -6; y <= 8; ++y)
        for (const double z : {-1.0, 0.0, 3.0})
          cases.push_back({Vec3(0.5 * x, 0.5 * y, z), a, b, c});
  EXPECT_EQ(expect_same(cases), 0);
}

TEST(ClosestPointLanes, LeaveSliversToTheTwin) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0);
  std::vector<Case> cases;
  for (const Vec3& p : {Vec3(2, 1, 0), Vec3(-1, 0, 0), Vec3(9, 1, 1), Vec3(0.5, 0, 0)})
    for (const auto& [u, v, w] :
         {std::array{a, b, c}, {c, a, b}, {a, a, c}, {b, b, b}, {a, b, Vec3(3, 1e-7, 0)}})
      cases.push_back({p, u, v, w});
  EXPECT_EQ(expect_same(cases), static_cast<int>(cases.size()));
  for (Case& k : cases) k = {k[0], a, b, Vec3(3, 1e-4, 0)};  // thin, but not that thin
  EXPECT_EQ(expect_same(cases), 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(answers_of({{a, b, c, Vec3(nan, 0, 0)}})[0].sliver);
}

TEST(ClosestPointLanes, DoNotDependOnTheirNeighbours) {
  auto random = reference::stream(72);
  std::vector<Case> cases(kLanes);
  for (Case& c : cases)
    for (Vec3& x : c) x = reference::random_vector(random, 2);
  cases[3][2] = cases[3][1];  // a sliver among them
  const std::vector<Answer> together = answers_of(cases);
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (together[k].sliver) continue;
    EXPECT_EQ(answers_of({cases[k]})[0], together[k]);
  }
  EXPECT_TRUE(together[3].sliver);
}

}  // namespace
}  // namespace acinus::geometry
