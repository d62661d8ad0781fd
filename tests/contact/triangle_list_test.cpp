#include "contact/triangle_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

TEST(HalfFloat, RoundsTowardsZeroByLessThanOneIn128) {
  auto random = reference::stream(41);
  for (int k = 0; k < 1000; ++k) {
    const auto x = static_cast<float>(random.uniform(-3, 3));
    const float kept = HalfFloat(x).value();
    EXPECT_LE(std::abs(kept), std::abs(x));
    EXPECT_LE(std::abs(x - kept), std::abs(x) / 128);
    EXPECT_GE(kept * x, 0);
  }
  EXPECT_EQ(HalfFloat().value(), 0);
}

TEST(TriangleList, KeepsNumbersAndLowerBounds) {
  auto random = reference::stream(42);
  for (const int most : {300, 65536, 1000000}) {  // of the second, two bytes are just enough
    std::vector<int> triangle{most - 1};
    std::vector<float> bound{2};
    for (int k = 0; k < 100; ++k) {
      triangle.push_back(static_cast<int>(random.uniform(0, most)));
      bound.push_back(static_cast<float>(random.uniform(0, 2)));
    }
    TriangleList list;
    list.assign(triangle, bound);
    ASSERT_EQ(list.size(), triangle.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      EXPECT_EQ(list.triangle_at(k), triangle[k]);
      EXPECT_LE(list.bound_at(k), bound[k]);
      EXPECT_GE(list.bound_at(k), bound[k] * 127 / 128);
    }
    list.assign(triangle, {});
    EXPECT_EQ(list.triangle_at(0), most - 1);
    EXPECT_EQ(list.bound_at(0), 0);
  }
}

}  // namespace
}  // namespace acinus::contact
