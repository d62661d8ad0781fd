/// Rows of all processes, handed over a part at a time.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "solve/system.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::solve {
namespace {

double value_of(std::size_t k) { return 0.5 + static_cast<double>(k); }

/// Rows of blocks of one and of five points, of random owners.
System make_system(const BlockPattern& one, const BlockPattern& five, std::uint64_t seed) {
  constexpr std::size_t kBlockCount = 40;
  System s;
  s.ownership.ranks = Ranks::world();
  std::mt19937_64 random(seed);
  std::vector<Block> blocks(kBlockCount);
  for (Block& b : blocks) {
    b.pattern = random() % 2 == 0 ? &one : &five;
    const auto n = static_cast<unsigned>(s.ownership.ranks.size());
    if (n > 1) s.ownership.owner.push_back(static_cast<int>(random() % n));
  }
  set_blocks(s, blocks);
  return s;
}

TEST(StreamRows, GivesTheRowsOfTheOwnersInTheirOrder) {
  BlockPattern one, five;
  one.n_point = 1;
  five.n_point = 5;
  for (const std::size_t most : {std::size_t{1}, std::size_t{12}, std::size_t{100000}}) {
    const System s = make_system(one, five, most);
    std::vector<double> own(s.n_dof(), -1), all(s.n_dof(), -2);
    for_each_own_number(s, [&](std::size_t k) { own[k] = value_of(k); });
    std::size_t next = 0;
    stream_rows(
        s, own,
        [&](std::size_t first, std::span<const double> rows) {
          EXPECT_EQ(first, next);
          next = first + rows.size();
          std::ranges::copy(rows, all.begin() + static_cast<std::ptrdiff_t>(first));
        },
        most);
    EXPECT_EQ(next, s.n_dof());
    for (std::size_t k = 0; k < all.size(); ++k) ASSERT_EQ(all[k], value_of(k)) << k;
  }
}

TEST(StreamRows, GatheredRowsReplaceThoseOfOthers) {
  BlockPattern one, five;
  one.n_point = 1;
  five.n_point = 5;
  const System s = make_system(one, five, 3);
  std::vector<double> x(s.n_dof(), -1);
  for_each_own_number(s, [&](std::size_t k) { x[k] = value_of(k); });
  gather_rows(s, x);
  for (std::size_t k = 0; k < x.size(); ++k) ASSERT_EQ(x[k], value_of(k)) << k;
}

TEST(ClearedRows, AreThoseOfOwnBlocks) {
  BlockPattern one, five;
  one.n_point = 1;
  five.n_point = 5;
  System s = make_system(one, five, 5);
  for (double& f : s.force) f = 1;
  clear_loads(s);
  for (std::size_t b = 0; b < s.block.size(); ++b)
    for (std::size_t k = s.row_of(b) * kPointStride; k < s.row_of(b + 1) * kPointStride; ++k)
      ASSERT_EQ(s.force[k], s.ownership.owns(b) ? 0 : 1);
}

}  // namespace
}  // namespace acinus::solve
