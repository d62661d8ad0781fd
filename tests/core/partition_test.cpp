#include "core/parallel/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

// Run as it stands and under mpirun.

namespace acinus {
namespace {

TEST(Partition, EveryoneHasAboutTheSameCostAndAllAgree) {
  const Ranks ranks = Ranks::world();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-100, 100), price(0.5, 2);
  std::vector<Vec3> place;
  std::vector<double> cost;
  for (int k = 0; k < 3000; ++k) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    place.emplace_back(x, y, z);
    cost.push_back(x > 0 ? 3 * price(random) : price(random));  // one half is dearer
  }
  const std::vector<int> owner = partition(ranks, place, cost);
  ASSERT_EQ(owner.size(), place.size());
  std::vector<double> of_rank(static_cast<std::size_t>(ranks.size()), 0);
  double all = 0;
  for (std::size_t k = 0; k < owner.size(); ++k) {
    of_rank.at(static_cast<std::size_t>(owner[k])) += cost[k];
    all += cost[k];
  }
  EXPECT_LT(*std::ranges::max_element(of_rank), 1.05 * all / ranks.size());
  std::vector<int> of_root = owner;
  ranks.broadcast(of_root);
  EXPECT_EQ(owner, of_root);
}

TEST(Partition, FewerPlacesThanProcessesAreNoError) {
  const Ranks ranks = Ranks::world();
  const std::vector<Vec3> place(1, Vec3::Zero());
  const std::vector<double> cost(1, 1.0);
  const std::vector<int> owner = partition(ranks, place, cost);
  ASSERT_EQ(owner.size(), 1U);
  EXPECT_LT(owner[0], ranks.size());
  EXPECT_TRUE(partition(ranks, {}, {}).empty());
}

}  // namespace
}  // namespace acinus
