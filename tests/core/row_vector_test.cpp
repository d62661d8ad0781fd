/// Row vectors have memory only where they were written.

#include "core/parallel/row_vector.hpp"

#include <gtest/gtest.h>

#include "core/parallel/make_room.hpp"

namespace acinus {
namespace {

constexpr std::size_t kLong = 1 << 20;  // numbers, 8 MB
constexpr bool kMapped = RowVector<double>::allocator_type::is_mapped(kLong);

TEST(RowVector, HasMemoryOnlyWhereItWasWritten) {
  if (!kMapped) GTEST_SKIP() << "arrays are not mapped with AddressSanitizer";
  use_small_pages();
  RowVector<double> v;
  set_size(v, kLong);
  EXPECT_EQ(memory_of(v), 0u);
  constexpr std::size_t kFirst = kLong / 2, kWritten = 10000;
  for (std::size_t k = kFirst; k < kFirst + kWritten; ++k) v[k] = 1;
  EXPECT_GE(memory_of(v), kWritten * sizeof(double));
  EXPECT_LE(memory_of(v), kWritten * sizeof(double) + 2 * 65536);  // two pages of any machine
  release_rows(v);
  EXPECT_EQ(memory_of(v), 0u);
  EXPECT_EQ(v.size(), kLong);
  EXPECT_EQ(v[kFirst], 0) << "released pages are zero";
}

TEST(RowVector, GrowsWithoutWriting) {
  if (!kMapped) GTEST_SKIP() << "arrays are not mapped with AddressSanitizer";
  RowVector<float> v;
  set_size(v, kLong);
  v[7] = 1;
  set_size(v, 2 * kLong);
  EXPECT_EQ(memory_of(v), 0u) << "what was there is lost with the old place";
  v[7] = 2;
  set_size(v, 2 * kLong - 1);
  EXPECT_EQ(v[7], 2) << "kept where the vector stays in place";
}

TEST(RowVector, ShortOnesAreCopiedAndCompared) {
  RowVector<double> v;
  v.assign(20, 0.0);
  v[3] = 5;
  const RowVector<double> copy = v;
  EXPECT_EQ(copy, v);
  v.push_back(1);
  EXPECT_NE(copy, v);
  EXPECT_EQ(copy[3], 5);
}

TEST(LargeVector, KeepsItsValuesWhenItIsMapped) {
  LargeVector<double> v(20, 3.0);
  v.resize(kLong);
  v[kLong - 1] = 4;
  EXPECT_EQ(v[19], 3);
  EXPECT_EQ(v[0], 3);
  EXPECT_EQ(memory_of(v), v.capacity() * sizeof(double));
  const LargeVector<double> copy = v;
  v.resize(2);
  v.shrink_to_fit();
  EXPECT_EQ(v, LargeVector<double>(2, 3.0));
  EXPECT_EQ(copy[kLong - 1], 4);
}

}  // namespace
}  // namespace acinus
