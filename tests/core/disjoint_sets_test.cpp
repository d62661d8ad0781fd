/// Sets joined by one thread and by several.

#include "core/parallel/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "core/parallel/threads.hpp"

namespace acinus {
namespace {

TEST(DisjointSets, AreStoodForByTheirLowestNumber) {
  DisjointSets sets(6);
  sets.join(5, 3);
  sets.join(3, 4);
  sets.join(1, 4);
  EXPECT_EQ(sets.find(5), 1);
  EXPECT_EQ(sets.find(3), 1);
  EXPECT_EQ(sets.find(0), 0);
  EXPECT_EQ(sets.find(2), 2);
}

/// Set of each number by spreading the lowest one until nothing changes.
std::vector<int> spread_lowest(int n, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<int> lowest(n);
  for (int k = 0; k < n; ++k) lowest[k] = k;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : pairs) {
      const int low = std::min(lowest[a], lowest[b]);
      changed = changed || lowest[a] != low || lowest[b] != low;
      lowest[a] = lowest[b] = low;
    }
  }
  return lowest;
}

TEST(DisjointSets, AreTheSameWhoeverJoinsWhatAndWhen) {
  std::mt19937 random(7);
  for (const int n : {50, 2000}) {
    // Fewer pairs than numbers, and more: small sets, and one that holds nearly all.
    for (const int n_pair : {n / 3, n / 2, 2 * n}) {
      std::uniform_int_distribution<int> any(0, n - 1);
      std::vector<std::pair<int, int>> pairs(n_pair);
      for (auto& [a, b] : pairs) {
        a = any(random);
        b = any(random);
      }
      const std::vector<int> expected = spread_lowest(n, pairs);
      set_threads(4);
      for (int repeat = 0; repeat < 50; ++repeat) {
        DisjointSets sets(n);
        for_each_index(pairs.size(), true,
                       [&](std::size_t k) { sets.join(pairs[k].first, pairs[k].second); });
        for (int k = 0; k < n; ++k) ASSERT_EQ(sets.find(k), expected[k]);
      }
      set_threads(1);
    }
  }
}

}  // namespace
}  // namespace acinus
