#include "contact/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/parallel/threads.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

struct Cloud {
  std::vector<Vec3> center;
  std::vector<double> radius;

  void add(const Vec3& x, double r) {
    center.push_back(x);
    radius.push_back(r);
  }
  /// [row][3][lane]; lanes without a sphere lie in the middle of the cloud and must not count.
  std::vector<double> position() const {
    const std::size_t n_row = (center.size() + kLanes - 1) / kLanes;
    std::vector<double> x(n_row * kPointStride, 0.0);
    for (std::size_t i = 0; i < center.size(); ++i)
      store_point(x.data(), make_address(i / kLanes, static_cast<int>(i % kLanes)), center[i]);
    return x;
  }
  Pairs pairs(double margin) const {
    const std::vector<double> x = position();
    Pairs found{{-1, -1}};  // replaced
    find_sphere_pairs(x.data(), radius, margin, {}, found);
    return found;
  }
  Pairs every_pair_tried(double margin) const {
    Pairs found;
    for (std::size_t i = 0; i < center.size(); ++i)
      for (std::size_t j = i + 1; j < center.size(); ++j) {
        const double reach = radius[i] + radius[j] + margin;
        if ((center[i] - center[j]).squaredNorm() <= reach * reach)
          found.emplace_back(static_cast<int>(i), static_cast<int>(j));
      }
    return found;
  }
};

Cloud random_cloud(std::uint64_t seed, int n, double half_width, double least, double largest) {
  auto random = reference::stream(seed);
  Cloud cloud;
  for (int k = 0; k < n; ++k) {
    const Vec3 x = reference::random_vector(random, half_width);
    cloud.add(x, random.uniform(least, largest));
  }
  return cloud;
}

/// Runs f with 1, 2 and 3 threads.
template <class F>
void with_each_number_of_threads(F f) {
  const int before = thread_count();
  for (const int n : {1, 2, 3}) {
    set_threads(n);
    f(n);
  }
  set_threads(before);
}

TEST(FindSpherePairs, FindsWhatTryingEveryPairFinds) {
  for (const int n : {0, 1, 2, 7, 8, 9, 500})
    for (const double half_width : {5.0, 40.0, 90.0})
      for (const double margin : {0.0, 0.3, 4.0}) {
        const Cloud cloud = random_cloud(70, n, half_width, 4, 12);
        const Pairs expected = cloud.every_pair_tried(margin);
        with_each_number_of_threads([&](int n_thread) {
          EXPECT_EQ(cloud.pairs(margin), expected)
              << n << " spheres, width " << half_width << ", margin " << margin << ", " << n_thread
              << " threads";
        });
        if (n == 500) {
          std::printf("500 spheres, half width %.0f, margin %.1f: %zu pairs\n", half_width, margin,
                      expected.size());
          EXPECT_GT(expected.size(), 100u);
        }
      }
}

TEST(FindSpherePairs, UnequalRadii) {
  Cloud cloud = random_cloud(71, 400, 60, 0.1, 1);
  const Cloud large = random_cloud(72, 9, 60, 10, 25);
  for (std::size_t k = 0; k < large.center.size(); ++k) cloud.add(large.center[k], large.radius[k]);
  for (const double margin : {0.0, 0.5}) {
    const Pairs expected = cloud.every_pair_tried(margin);
    EXPECT_GT(expected.size(), 50u);
    with_each_number_of_threads([&](int) { EXPECT_EQ(cloud.pairs(margin), expected); });
  }
}

TEST(FindSpherePairs, Scattered) {
  // Most of a grid would be empty: pairs of neighbours thousands of radii from each other.
  auto random = reference::stream(73);
  Cloud cloud;
  for (int k = 0; k < 60; ++k) {
    const Vec3 x = reference::random_vector(random, 1e5);
    cloud.add(x, 5);
    if (k % 2 == 0) cloud.add(x + reference::random_vector(random, 6), random.uniform(1, 6));
  }
  for (const double margin : {0.0, 1.0}) {
    const Pairs expected = cloud.every_pair_tried(margin);
    EXPECT_GT(expected.size(), 10u);
    EXPECT_LT(expected.size(), 40u);
    with_each_number_of_threads([&](int) { EXPECT_EQ(cloud.pairs(margin), expected); });
  }
}

TEST(FindSpherePairs, OneFarRunawayDoesNotHideTheOthers) {
  Cloud cloud = random_cloud(74, 100, 30, 3, 8);
  const Pairs pairs = cloud.pairs(0.5);
  EXPECT_EQ(pairs, cloud.every_pair_tried(0.5));
  cloud.add({-1e9, 2e3, 1e7}, 8);
  EXPECT_EQ(cloud.pairs(0.5), pairs);
}

TEST(FindSpherePairs, AllInOnePlace) {
  Cloud cloud;
  for (int k = 0; k < 37; ++k) cloud.add({3, -4, 5}, 2);
  with_each_number_of_threads([&](int) {
    const Pairs pairs = cloud.pairs(0);
    EXPECT_EQ(pairs.size(), 37u * 36 / 2);
    EXPECT_EQ(pairs, cloud.every_pair_tried(0));
  });
}

TEST(FindSpherePairs, InALineAndInAPlane) {
  Cloud line, plane;
  for (int k = 0; k < 100; ++k) {
    line.add({0, 0, 1.5 * k}, 1);
    plane.add({1.9 * (k % 10), 1.9 * static_cast<double>(k / 10), 0}, 1);
  }
  EXPECT_EQ(line.pairs(0).size(), 99u);
  EXPECT_EQ(plane.pairs(0).size(), 180u);
  EXPECT_EQ(line.pairs(0), line.every_pair_tried(0));
  EXPECT_EQ(plane.pairs(0.8), plane.every_pair_tried(0.8));
}

TEST(FindSpherePairs, OnTheCornersOfTheGrid) {
  // Whole multiples of the grid's width, which is also exactly the reach: every neighbour counts.
  Cloud cloud;
  for (int k = 0; k < 216; ++k)
    cloud.add({4.0 * (k % 6), 4.0 * (k / 6 % 6), 4.0 * static_cast<double>(k / 36)}, 2);
  const Pairs pairs = cloud.pairs(0);
  EXPECT_EQ(pairs.size(), 3u * 36 * 5);
  EXPECT_EQ(pairs, cloud.every_pair_tried(0));
}

TEST(FindSpherePairs, FarFromTheOrigin) {
  Cloud cloud = random_cloud(75, 200, 40, 3, 9);
  const Pairs pairs = cloud.pairs(0.25);
  for (Vec3& x : cloud.center) x += Vec3(3e4, -2e4, 1e4);
  EXPECT_EQ(cloud.pairs(0.25), cloud.every_pair_tried(0.25));
  EXPECT_EQ(cloud.pairs(0.25), pairs);
}

TEST(FindSpherePairs, AscendWithTheFirstBelowTheSecond) {
  for (const double half_width : {40.0, 1e6}) {
    Cloud cloud = random_cloud(76, 300, half_width, 3, 9);
    for (int k = 0; k < 20; ++k) cloud.add(cloud.center[7 * k], 1);
    const Pairs pairs = cloud.pairs(1);
    EXPECT_FALSE(pairs.empty());
    EXPECT_TRUE(std::ranges::is_sorted(pairs));
    EXPECT_EQ(std::ranges::adjacent_find(pairs), pairs.end()) << "a pair twice";
    for (const auto& [i, j] : pairs) EXPECT_LT(i, j);
  }
}

}  // namespace
}  // namespace acinus::contact
