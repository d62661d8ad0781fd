#include "geometry/box_pairs.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/threads.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

std::vector<Box> random_boxes(std::uint64_t seed, int n, double world) {
  auto random = reference::stream(seed);
  std::vector<Box> boxes;
  for (int k = 0; k < n; ++k) {
    const Vec3 middle = reference::random_vector(random, world);
    const double size = k % 20 == 0 ? 12 : k % 3 == 0 ? 0.5 : 4;
    boxes.push_back({middle, middle});
    boxes.back().include(middle + reference::random_vector(random, size));
    boxes.back().include(middle + reference::random_vector(random, size));
  }
  return boxes;
}

bool near(const Box& a, const Box& b, double margin) {
  for (int k = 0; k < 3; ++k)
    if (a.low[k] - margin > b.high[k] || b.low[k] - margin > a.high[k]) return false;
  return true;
}

TEST(FindPairs, FindsWhatTryingEveryPairFinds) {
  for (double margin : {0.0, 0.3, 3.0}) {
    const auto boxes = random_boxes(40, 500, 25);
    std::vector<std::pair<int, int>> expected;
    for (int i = 0; i < 500; ++i)
      for (int j = i + 1; j < 500; ++j)
        if (near(boxes[i], boxes[j], margin)) expected.emplace_back(i, j);
    EXPECT_EQ(find_pairs(boxes, margin), expected);
    std::printf("margin %.1f: %zu pairs of 500 boxes\n", margin, expected.size());
    EXPECT_GT(expected.size(), 100u);
  }
}

TEST(FindPairs, AreTheSameOnThreeThreads) {
  const auto boxes = random_boxes(45, 3000, 60);
  const auto pairs = find_pairs(boxes, 0.5);
  set_threads(3);
  EXPECT_EQ(find_pairs(boxes, 0.5), pairs);
  set_threads(1);
  EXPECT_GT(pairs.size(), 1000u);
}

TEST(FindPairs, BetweenTwoSets) {
  const auto a = random_boxes(41, 200, 40), b = random_boxes(42, 300, 40);
  for (double margin : {0.0, 1.0}) {
    std::vector<std::pair<int, int>> expected;
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 300; ++j)
        if (near(a[i], b[j], margin)) expected.emplace_back(i, j);
    EXPECT_EQ(find_pairs_between(a, b, margin), expected);
  }
}

TEST(FindPairs, FarFromTheOriginAndFewBoxes) {
  auto boxes = random_boxes(43, 40, 10);
  const auto pairs = find_pairs(boxes, 1);
  for (Box& b : boxes) {
    b.low += Vec3(3e4, -2e4, 1e4);
    b.high += Vec3(3e4, -2e4, 1e4);
  }
  EXPECT_EQ(find_pairs(boxes, 1), pairs);
  EXPECT_TRUE(find_pairs({}, 1).empty());
  EXPECT_TRUE(find_pairs(std::vector<Box>{boxes[0]}, 1).empty());
  EXPECT_TRUE(find_pairs_between(boxes, {}, 1).empty());
  EXPECT_TRUE(find_pairs_between({}, boxes, 1).empty());
}

TEST(FindPairs, OneFarRunawayDoesNotHideTheOthers) {
  auto boxes = random_boxes(44, 60, 10);
  const auto pairs = find_pairs(boxes, 0.5);
  boxes.push_back(sphere_box(Vec3(1e9, 0, 0), 1));
  EXPECT_EQ(find_pairs(boxes, 0.5), pairs);
}

TEST(Box, OverlapsContainsAndGrows) {
  const Box a = sphere_box({0, 0, 0}, 1), b = sphere_box({2.5, 0, 0}, 1);
  EXPECT_FALSE(a.overlaps(b));
  EXPECT_TRUE(a.grown(0.5).overlaps(b));
  EXPECT_TRUE(a.contains({1, 1, -1}));
  EXPECT_FALSE(a.contains({1.01, 0, 0}));
  EXPECT_FALSE(Box{}.contains({0, 0, 0}));
}

}  // namespace
}  // namespace acinus::geometry
