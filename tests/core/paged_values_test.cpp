/// Values that are stored once where they are the same.

#include "core/parallel/paged_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/vec.hpp"

namespace acinus {
namespace {

TEST(PagedValues, AreThoseThatWereSet) {
  for (const std::size_t n : {1, 63, 64, 65, 1000}) {
    std::vector<double> wanted(n, 0.5);
    PagedValues<double> values(wanted);
    for (std::size_t k = 0; k < n; k += 97) {
      wanted[k] = static_cast<double>(k) + 1;
      values.set(k, wanted[k]);
    }
    ASSERT_EQ(values.size(), n);
    EXPECT_TRUE(std::equal(values.begin(), values.end(), wanted.begin(), wanted.end())) << n;
    const PagedValues<double> copy(n, [&](std::size_t k) { return values[k]; });
    EXPECT_TRUE(std::equal(copy.begin(), copy.end(), wanted.begin(), wanted.end())) << n;
  }
}

TEST(PagedValues, TakeMemoryOnlyWhereTheyDiffer) {
  constexpr std::size_t kMany = 100'000;
  PagedValues<Vec3> values(std::vector<Vec3>(kMany, Vec3::Zero()));
  EXPECT_LT(values.memory(), kMany);
  values.set(777, Vec3(0, 1, 0));
  EXPECT_LT(values.memory(), kMany + 64 * sizeof(Vec3));
  EXPECT_EQ(values[777], Vec3(0, 1, 0));
  EXPECT_EQ(values[776], Vec3::Zero());
  values.replace([](const Vec3& v) { return Vec3(2 * v); });
  EXPECT_EQ(values[777], Vec3(0, 2, 0));
  values.replace([](const Vec3&) { return Vec3::Zero(); });
  EXPECT_LT(values.memory(), kMany);
}

TEST(PagedValues, KeepTheSignOfZero) {
  PagedValues<double> values(std::vector<double>(100, 0.0));
  values.set(3, -0.0);
  EXPECT_TRUE(std::signbit(values[3]));
  EXPECT_FALSE(std::signbit(values[2]));
}

}  // namespace
}  // namespace acinus
