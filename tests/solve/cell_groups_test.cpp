#include "solve/cell_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "core/parallel/threads.hpp"
#include "tests/solve/systems.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::solve {
namespace {

constexpr std::size_t kSphereBlocks = 60;
constexpr int kCells = static_cast<int>(kSphereBlocks * kLanes);

/// Pairs of cells in contact: chains, clusters and cells that touch none.
std::vector<std::array<int, 2>> draw_pairs(std::uint64_t seed, int n) {
  std::mt19937_64 random(seed);
  std::vector<std::array<int, 2>> pairs;
  for (int k = 0; k < n; ++k) {
    const int a = static_cast<int>(random() % kCells), b = static_cast<int>(random() % kCells);
    if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// Spheres with the contacts of own cells, a third of which do not touch yet.
System make_spheres(const Ownership& ownership, const std::vector<std::array<int, 2>>& pairs) {
  System s;
  s.ownership = ownership;
  Blocks blocks;
  blocks.append_points(kSingle, kSphereBlocks);
  set_blocks(s, blocks);
  for (const auto& [a, b] : pairs) {
    if (!s.owns(static_cast<Point>(a)) && !s.owns(static_cast<Point>(b))) continue;
    PointLink link;
    link.a = static_cast<Point>(a);
    link.b = static_cast<Point>(b);
    link.stiffness = (a + b) % 3 == 0 ? 0 : 1;
    link.friction = 0;
    s.point_links.push_back(link);
  }
  return s;
}

/// Lowest cell of the group of each cell, by spreading it along the contacts that have a matrix.
std::vector<int> spread_lowest(const std::vector<std::array<int, 2>>& pairs) {
  std::vector<int> lowest(kCells);
  for (int c = 0; c < kCells; ++c) lowest[c] = c;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : pairs) {
      if ((a + b) % 3 == 0) continue;
      const int low = std::min(lowest[a], lowest[b]);
      changed = changed || lowest[a] != low || lowest[b] != low;
      lowest[a] = lowest[b] = low;
    }
  }
  return lowest;
}

/// Own cell with the lowest cell of its group and the group's numbers here.
struct Known {
  int lowest, group, shared;
};

TEST(CellGroups, AreThoseOfOneProcess) {
  const Ranks ranks = Ranks::world();
  const std::vector<std::uint8_t> active(kCells, 1);
  std::mt19937_64 random(7);
  for (const int n_pair : {0, 60, 200, 600}) {
    const auto pairs = draw_pairs(5, n_pair);
    const std::vector<int> lowest = spread_lowest(pairs);
    Ownership shared{ranks, {}};
    for (std::size_t b = 0; b < kSphereBlocks && !ranks.is_alone(); ++b)
      shared.owner.push_back(static_cast<int>(random() % static_cast<unsigned>(ranks.size())));
    for (const int threads : {1, 2}) {
      set_threads(threads);
      const System s = make_spheres(shared, pairs);
      CellGroups groups;
      find_groups(s, active, groups);
      std::vector<Known> own, all;
      std::set<int> numbers;
      for (int c = 0; c < kCells; ++c) {
        if (!s.owns(static_cast<Point>(c))) continue;
        const int group = groups.of_cell[c];
        const auto at = std::ranges::find(groups.shared, group);
        own.push_back(
            {lowest[c], group,
             at == groups.shared.end() ? -1 : static_cast<int>(at - groups.shared.begin())});
        numbers.insert(group);
      }
      EXPECT_EQ(numbers.size(), groups.n);
      std::map<int, int> group_of;
      for (const Known& k : own)
        EXPECT_EQ(group_of.try_emplace(k.lowest, k.group).first->second, k.group);
      EXPECT_EQ(group_of.size(), groups.n);
      std::vector<std::size_t> start;
      ranks.gather<Known>(own, all, &start);
      std::map<int, std::set<int>> ranks_of, shared_of;
      for (std::size_t r = 0; r + 1 < start.size(); ++r)
        for (std::size_t k = start[r]; k < start[r + 1]; ++k) {
          ranks_of[all[k].lowest].insert(static_cast<int>(r));
          shared_of[all[k].lowest].insert(all[k].shared);
        }
      std::set<int> listed;
      for (const auto& [low, of] : ranks_of) {
        ASSERT_EQ(shared_of[low].size(), 1U) << low;
        const int number = *shared_of[low].begin();
        EXPECT_EQ(number >= 0, of.size() > 1) << low;
        if (number >= 0) {
          EXPECT_TRUE(listed.insert(number).second) << low;
        }
      }
      EXPECT_EQ(listed.size(), groups.shared.size());
    }
    set_threads(1);
  }
}

}  // namespace
}  // namespace acinus::solve
