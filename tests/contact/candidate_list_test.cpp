#include "contact/candidate_list.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

/// Random list with numbers below `most`, the largest of them included.
WideCandidates make_list(int most, int n_point, UniformStream& random) {
  WideCandidates list;
  list.start.push_back(0);
  for (int p = 0; p < n_point; ++p) {
    list.point.push_back(p == 0 ? most - 1 : static_cast<int>(random.uniform(0, most)));
    list.gap.push_back(static_cast<float>(random.uniform(-3, 3)));
    for (int k = 0; k < 1 + p % 4; ++k) {
      list.triangle.push_back(k == 0 ? most - 1 : static_cast<int>(random.uniform(0, most)));
      list.bound.push_back(static_cast<float>(random.uniform(0, 2)));
    }
    list.start.push_back(static_cast<std::uint32_t>(list.triangle.size()));
  }
  return list;
}

// Numbers are kept, and lengths rounded towards zero by less than 1 in 128.
TEST(CandidateList, KeepsNumbersAndBounds) {
  auto random = reference::stream(42);
  for (const int most : {300, 65536, 1'000'000})  // of the second, two bytes are just enough
    for (const int n_point : {1, 2, 101}) {
      const WideCandidates from = make_list(most, n_point, random);
      CandidateList list;
      list.assign(from);
      ASSERT_EQ(list.n_point(), from.point.size());
      ASSERT_EQ(list.n_triangle(), from.triangle.size());
      for (std::size_t p = 0; p < list.n_point(); ++p) {
        EXPECT_EQ(list.point_at(p), from.point[p]);
        EXPECT_EQ(list.begin_of(p), from.start[p]);
        EXPECT_EQ(list.end_of(p), from.start[p + 1]);
        const float gap = list.gap_at(p), exact = from.gap[p];
        EXPECT_LE(std::abs(gap), std::abs(exact));
        EXPECT_LE(std::abs(exact - gap), std::abs(exact) / 128);
        EXPECT_GE(gap * exact, 0);
      }
      for (std::size_t k = 0; k < list.n_triangle(); ++k) {
        EXPECT_EQ(list.triangle_at(k), from.triangle[k]);
        EXPECT_LE(list.bound_at(k), from.bound[k]);
        EXPECT_GE(list.bound_at(k), from.bound[k] * 127 / 128);
      }
    }
}

TEST(CandidateList, ManyTrianglesOfFewPoints) {
  WideCandidates from;
  from.start = {0, 70'000};
  from.point = {3};
  from.triangle.assign(70'000, 5);
  CandidateList list;
  list.assign(from);
  EXPECT_EQ(list.end_of(0), 70'000u);
  EXPECT_EQ(list.point_at(0), 3);
  EXPECT_EQ(list.triangle_at(69'999), 5);
  EXPECT_EQ(list.gap_at(0), 0);
  EXPECT_EQ(list.bound_at(0), 0);
}

TEST(CandidateList, EmptyAfterAnEmptyOne) {
  auto random = reference::stream(43);
  CandidateList list;
  EXPECT_TRUE(list.empty());
  list.assign(make_list(300, 5, random));
  EXPECT_FALSE(list.empty());
  WideCandidates none;
  none.start = {0};
  list.assign(none);
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.memory(), 0u);
}

}  // namespace
}  // namespace acinus::contact
