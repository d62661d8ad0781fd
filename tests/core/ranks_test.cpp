#include "core/ranks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/error.hpp"

// Run as it stands (one process, MPI never touched) and under mpirun: the claims are the same.

namespace acinus {
namespace {

TEST(Ranks, WorldHasAsManyProcessesAsTheStart) {
  const char* expected = std::getenv("ACINUS_TEST_RANKS");
  const Ranks ranks = Ranks::world();
  EXPECT_EQ(ranks.size(), expected ? std::atoi(expected) : 1);
  EXPECT_EQ(ranks.is_root(), ranks.rank() == 0);
  EXPECT_EQ(Ranks::world().rank(), ranks.rank());  // the second call starts nothing
}

TEST(Ranks, SerialIsTheIdentity) {
  const Ranks ranks = Ranks::serial();
  EXPECT_EQ(ranks.size(), 1);
  std::vector<double> values = {1.0, 2.0};
  ranks.sum(values);
  EXPECT_EQ(values, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(ranks.sum(3.0), 3.0);
  EXPECT_EQ(ranks.max(-1.0), -1.0);
  EXPECT_EQ(ranks.agree_worst(75), 75);
  ranks.barrier();
}

// The sum in rank order, done again here from what each rank would give.
TEST(Ranks, SumsInRankOrder) {
  const Ranks ranks = Ranks::world();
  const auto share = [](int rank, std::size_t i) {
    return std::sin(1.0 + rank + 0.1 * static_cast<double>(i)) *
           std::pow(10.0, rank * 3 - static_cast<int>(i % 9));
  };
  for (const std::size_t length : {0u, 1u, 1000u, 150'000u}) {  // the last takes three chunks
    std::vector<double> values(length);
    for (std::size_t i = 0; i < length; ++i) values[i] = share(ranks.rank(), i);
    ranks.sum(values);
    for (std::size_t i = 0; i < length; ++i) {
      double expected = share(0, i);
      for (int rank = 1; rank < ranks.size(); ++rank) expected += share(rank, i);
      ASSERT_EQ(values[i], expected) << i;
    }
  }
}

TEST(Ranks, MaxAndAnySeeEveryRank) {
  const Ranks ranks = Ranks::world();
  EXPECT_EQ(ranks.max(ranks.rank() * 2.0 - 100.0), (ranks.size() - 1) * 2.0 - 100.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(ranks.max(ranks.is_root() ? nan : 1.0)));
  EXPECT_TRUE(ranks.any(ranks.rank() == ranks.size() - 1));
  EXPECT_FALSE(ranks.any(false));
}

TEST(Ranks, TheGravestExitCodeWins) {
  const Ranks ranks = Ranks::world();
  const bool last = ranks.rank() == ranks.size() - 1;
  const int mild_to_grave[] = {0, 75, 2, 3, 4, 1};
  for (int mild = 0; mild < 6; ++mild) {
    for (int grave = mild; grave < 6; ++grave) {
      const int others = ranks.size() > 1 ? mild_to_grave[mild] : mild_to_grave[grave];
      EXPECT_EQ(ranks.agree_worst(last ? mild_to_grave[grave] : others), mild_to_grave[grave]);
    }
  }
  ranks.barrier();
}

TEST(Halo, DoesNothingOnOneRankAndRefusesMore) {
  const Ranks ranks = Ranks::world();
  const Halo halo = {ranks};
  std::vector<double> x = {1.0, 2.0};
  if (ranks.size() == 1) {
    halo.update(x);
    halo.add_back(x);
    EXPECT_EQ(x, (std::vector<double>{1.0, 2.0}));
  } else {
    EXPECT_THROW(halo.update(x), Error);
    EXPECT_THROW(halo.add_back(x), Error);
  }
}

}  // namespace
}  // namespace acinus
