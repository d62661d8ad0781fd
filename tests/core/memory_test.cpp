#include "core/parallel/memory.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace acinus {
namespace {

TEST(Memory, PeakSeesALargeBlock) {
  const std::uint64_t before = peak_rss_bytes();
  EXPECT_GT(before, 1u << 20);
  const std::vector<char> block(before + (32u << 20), 1);
  EXPECT_GE(peak_rss_bytes(), before + (16u << 20));
  EXPECT_EQ(block.back(), 1);
}

}  // namespace
}  // namespace acinus
