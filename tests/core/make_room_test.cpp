/// Arrays that are a little longer every step move seldom and stand nearly full.

#include "core/parallel/make_room.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace acinus {
namespace {

/// Number of moves of an array while n elements are added one at a time.
template <class Add>
int count_moves(std::vector<double>& v, int n, const Add& add) {
  int moves = 0;
  for (int k = 0; k < n; ++k) {
    const double* const before = v.data();
    add(v);
    moves += v.data() != before;
    EXPECT_LE(v.capacity(), v.size() + v.size() / 16 + 1);
  }
  return moves;
}

TEST(MakeRoom, AnArrayThatDoublesMovesTwelveTimes) {
  std::vector<double> one_by_one(1000), written_anew(1000);
  // 1000 to 2000 in steps of a sixteenth: log 2 / log (17/16) = 11.4.
  EXPECT_LE(count_moves(one_by_one, 1000, [](auto& v) { set_size(v, v.size() + 1); }), 13);
  EXPECT_LE(count_moves(written_anew, 1000,
                        [](auto& v) {
                          const std::size_t n = v.size() + 1;
                          v.clear();
                          set_size(v, n);
                        }),
            13);
}

// A full array that grows is there twice, so it gets its memory while it is empty.
TEST(MakeRoom, AnArrayThatIsRefilledDoesNotMoveForAFewMore) {
  std::vector<double> v(1000);
  for (int round = 0; round < 30; ++round) {
    const std::size_t n = v.size();
    clear_to_refill(v);
    EXPECT_TRUE(v.empty());
    const double* const before = v.data();
    for (std::size_t k = 0; k < n + n / 40; ++k) {
      make_room(v, 1);
      v.push_back(1);
    }
    EXPECT_EQ(v.data(), before);
    EXPECT_LE(v.capacity(), v.size() + v.size() / 8);
  }
}

}  // namespace
}  // namespace acinus
