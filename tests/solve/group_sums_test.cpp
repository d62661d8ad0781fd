#include "solve/group_sums.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/parallel/threads.hpp"
#include "core/sort_unique.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::solve {
namespace {

constexpr std::size_t kBlocks = 60;

System make_blocks(const BlockPattern& pattern, const Ownership& ownership) {
  System s;
  s.ownership = ownership;
  std::vector<Block> blocks(kBlocks);
  for (Block& b : blocks) b.pattern = &pattern;
  set_blocks(s, blocks);
  return s;
}

/// Groups of one cell, of a few, of many, and lanes without a cell.
std::vector<int> draw_groups(std::size_t& n_group) {
  std::mt19937_64 random(4);
  std::vector<int> group;
  int next = 2;
  for (std::size_t c = 0; c < kBlocks * kLanes; ++c) {
    const auto draw = random() % 10;
    if (draw == 0)
      group.push_back(-1);
    else if (draw < 5)
      group.push_back(static_cast<int>(draw % 2));
    else if (draw < 8)
      group.push_back(next++);
    else
      group.push_back(next - 1);
  }
  n_group = static_cast<std::size_t>(next);
  return group;
}

double value_at(Address a) {
  return std::sin(1.0 + a) * std::pow(10.0, static_cast<int>(a % 23) - 11);
}

/// Groups as the processes of a system know them, with the number of each here, -1: no own cell.
struct KnownGroups {
  CellGroups groups;
  std::vector<int> number;
};

KnownGroups know_groups(const System& s, const std::vector<int>& group, std::size_t n_group) {
  KnownGroups known{{}, std::vector<int>(n_group, -1)};
  known.groups.of_cell.assign(group.size(), -1);
  std::vector<std::vector<int>> owners(n_group);
  for (std::size_t c = 0; c < group.size(); ++c) {
    if (group[c] < 0) continue;
    owners[group[c]].push_back(s.ownership.is_whole() ? 0 : s.ownership.owner[c / kLanes]);
    if (!s.ownership.owns(c / kLanes)) continue;
    int& number = known.number[group[c]];
    if (number < 0) number = static_cast<int>(known.groups.n++);
    known.groups.of_cell[c] = number;
  }
  for (std::size_t g = 0; g < n_group; ++g) {
    sort_unique(owners[g]);
    if (owners[g].size() > 1) known.groups.shared.push_back(known.number[g]);
  }
  return known;
}

struct Sums {
  std::vector<std::array<double, 2>> sum;
  std::vector<double> largest;
};

Sums find_sums(const System& s, const std::vector<int>& group, std::size_t n_group) {
  const auto [groups, number] = know_groups(s, group, n_group);
  GroupSums sums;
  sums.prepare(s, groups);
  std::vector<std::array<double, 2>> sum(groups.n);
  std::vector<double> largest;
  sums.sum<2>(
      [](Address a, std::size_t, std::array<double, 2>& part) {
        part[0] += value_at(a);
        part[1] += 1;
      },
      [&](std::size_t g, const std::array<double, 2>& of_group) { sum[g] = of_group; });
  sums.largest([](Address a, std::size_t) { return std::abs(value_at(a)); }, largest);
  Sums found{std::vector<std::array<double, 2>>(n_group), std::vector<double>(n_group)};
  for (std::size_t g = 0; g < n_group; ++g) {
    if (number[g] < 0) continue;
    found.sum[g] = sum[number[g]];
    found.largest[g] = largest[number[g]];
  }
  return found;
}

TEST(GroupSums, AreTheSumsOverThePoints) {
  BlockPattern pattern;
  pattern.n_point = 5;
  const System s = make_blocks(pattern, {});
  std::size_t n_group = 0;
  const std::vector<int> group = draw_groups(n_group);
  const Sums found = find_sums(s, group, n_group);
  std::vector<long double> sum(n_group, 0), size(n_group, 0);
  std::vector<double> count(n_group, 0), largest(n_group, 0);
  for (std::size_t c = 0; c < group.size(); ++c) {
    if (group[c] < 0) continue;
    const auto g = static_cast<std::size_t>(group[c]);
    for (std::size_t i = 0; i < 5; ++i) {
      const double v =
          value_at(make_address(s.block[c / kLanes].first_row + i, static_cast<int>(c % kLanes)));
      sum[g] += static_cast<long double>(v);
      size[g] += std::abs(static_cast<long double>(v));
      largest[g] = std::max(largest[g], std::abs(v));
      ++count[g];
    }
  }
  for (std::size_t g = 0; g < n_group; ++g) {
    EXPECT_NEAR(found.sum[g][0], static_cast<double>(sum[g]), 1e-15 * static_cast<double>(size[g]));
    EXPECT_EQ(found.sum[g][1], count[g]);
    EXPECT_EQ(found.largest[g], largest[g]);
  }
}

TEST(GroupSums, HaveTheSameBitsWhoeverOwnsWhat) {
  const Ranks ranks = Ranks::world();
  BlockPattern pattern;
  pattern.n_point = 5;
  std::size_t n_group = 0;
  const std::vector<int> group = draw_groups(n_group);
  const Sums alone = find_sums(make_blocks(pattern, {}), group, n_group);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 5; ++trial) {
    Ownership shared{ranks, {}};
    for (std::size_t b = 0; b < kBlocks; ++b)
      shared.owner.push_back(static_cast<int>(random() % static_cast<unsigned>(ranks.size())));
    for (const int threads : {1, 2}) {
      set_threads(threads);
      const Sums found = find_sums(make_blocks(pattern, shared), group, n_group);
      // Of groups without a cell here nothing is known.
      for (std::size_t c = 0; c < group.size(); ++c) {
        if (group[c] < 0 || !shared.owns(c / kLanes)) continue;
        const auto g = static_cast<std::size_t>(group[c]);
        EXPECT_EQ(found.sum[g], alone.sum[g]);
        EXPECT_EQ(found.largest[g], alone.largest[g]);
      }
    }
  }
  set_threads(1);
}

}  // namespace
}  // namespace acinus::solve
