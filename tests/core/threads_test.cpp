#include "core/parallel/threads.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/parallel/append_in_order.hpp"

namespace acinus {
namespace {

struct Threads : ::testing::TestWithParam<int> {
  Threads() { set_threads(GetParam()); }
  ~Threads() override { set_threads(1); }
};

TEST_P(Threads, DoEveryPartOnce) {
  for (const std::size_t n : {1U, 2U, 3U, 7U, 1000U})
    for (int round = 0; round < 200; ++round) {
      std::vector<int> done(n, 0);
      for_each_part(n, [&](std::size_t part) { ++done[part]; });
      for (const int times : done) ASSERT_EQ(times, 1);
    }
}

TEST_P(Threads, DoEveryIndexOnce) {
  for (const std::size_t n : {0U, 1U, 5U, 12345U})
    for (const bool shared : {false, true}) {
      std::vector<int> done(n, 0);
      for_each_index(n, shared, [&](std::size_t k) { ++done[k]; });
      EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), static_cast<int>(n));
      for (const int times : done) ASSERT_EQ(times, 1);
    }
}

TEST_P(Threads, ShareNothingWithinSharedWork) {
  std::atomic<int> done = 0;
  for_each_part(8, [&](std::size_t) {
    EXPECT_EQ(count_threads(100000), 1U);
    for_each_part(8, [&](std::size_t) { ++done; });
  });
  EXPECT_EQ(done, 64);
  EXPECT_EQ(count_threads(100000), static_cast<std::size_t>(GetParam()));
}

TEST_P(Threads, AppendInTheOrderOfIndices) {
  for (const std::size_t n : {0U, 1U, 5U, 12345U})
    for (int round = 0; round < 20; ++round) {
      std::vector<std::size_t> all{7}, expected{7};
      const auto find = [](std::size_t k, std::vector<std::size_t>& out) {
        for (std::size_t m = 0; m < k % 7; ++m) out.push_back(10 * k + m);
        if (k % 97 == 0) std::this_thread::yield();  // its run comes late
      };
      for (std::size_t k = 0; k < n; ++k) find(k, expected);
      append_in_order(n, true, all, find);
      ASSERT_EQ(all, expected);
    }
}

TEST_P(Threads, HandOnWhatAPartThrows) {
  for (int round = 0; round < 50; ++round)
    EXPECT_THROW(for_each_part(4,
                               [&](std::size_t part) {
                                 if (part == 3) throw std::runtime_error("part 3");
                               }),
                 std::runtime_error);
  int done = 0;
  for_each_part(1, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 1);
}

// Two simulations in one process: one has the helpers, the other works alone.
TEST_P(Threads, ServeTwoCallersAtOnce) {
  std::array<std::atomic<int>, 2> done{};
  std::array<std::thread, 2> caller;
  for (std::size_t c = 0; c < caller.size(); ++c)
    caller[c] = std::thread([&, c] {
      for (int round = 0; round < 500; ++round) for_each_part(5, [&](std::size_t) { ++done[c]; });
    });
  for (std::thread& t : caller) t.join();
  for (const auto& n : done) EXPECT_EQ(n, 2500);
}

INSTANTIATE_TEST_SUITE_P(Numbers, Threads, ::testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace acinus
