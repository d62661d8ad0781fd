#include "core/parallel/ranks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

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

double sum(const Ranks& ranks, const std::vector<double>& terms) {
  ExactSum total;
  for (const double t : terms) total.add(t);
  ranks.sum(std::span(&total, 1));
  return total.value();
}

TEST(Ranks, SerialIsTheIdentity) {
  const Ranks ranks = Ranks::serial();
  EXPECT_EQ(ranks.size(), 1);
  EXPECT_TRUE(ranks.is_alone());
  EXPECT_EQ(sum(ranks, {1.0, 2.0}), 3.0);
  EXPECT_EQ(ranks.max(-1.0), -1.0);
  EXPECT_EQ(ranks.min(-1), -1);
  EXPECT_EQ(ranks.agree_worst(75), 75);
  const std::vector<int> own = {3, 4};
  std::vector<int> all;
  std::vector<std::size_t> start;
  ranks.gather<int>(own, all, &start);
  EXPECT_EQ(all, own);
  EXPECT_EQ(start, (std::vector<std::size_t>{0, 2}));
  ranks.barrier();
}

// The sum is that of one process for any distribution of the terms.
TEST(Ranks, SumsExactly) {
  const Ranks ranks = Ranks::world();
  const auto term = [](int k) { return std::sin(1.0 + k) * std::pow(10.0, k % 37 - 18); };
  constexpr int kTerms = 1000;
  std::vector<double> all, own;
  for (int k = 0; k < kTerms; ++k) {
    all.push_back(term(k));
    if (k * k % 7 % ranks.size() == ranks.rank()) own.push_back(term(k));
  }
  EXPECT_EQ(sum(ranks, own), sum(Ranks::serial(), all));
  EXPECT_TRUE(std::isnan(sum(ranks, {ranks.is_root() ? std::nan("") : 1.0})));
  EXPECT_TRUE(std::isinf(sum(ranks, {ranks.is_root() ? HUGE_VAL : 1.0})));
}

TEST(Ranks, GathersInTheirOrder) {
  const Ranks ranks = Ranks::world();
  std::vector<double> own(static_cast<std::size_t>(ranks.rank()) * 3, ranks.rank()), all;
  std::vector<std::size_t> start;
  ranks.gather<double>(own, all, &start);
  std::vector<double> expected;
  std::vector<std::size_t> begin{0};
  for (int r = 0; r < ranks.size(); ++r) {
    expected.insert(expected.end(), static_cast<std::size_t>(r) * 3, r);
    begin.push_back(expected.size());
  }
  EXPECT_EQ(all, expected);
  EXPECT_EQ(start, begin);
}

// Everyone sends as many numbers as the ranks of both ends say.
TEST(Ranks, ExchangesWithPeers) {
  const Ranks ranks = Ranks::world();
  ExchangePlan plan;
  std::vector<int> out, expected;
  for (int peer = 0; peer < ranks.size(); ++peer) {
    if (peer == ranks.rank()) continue;
    const auto n = static_cast<std::size_t>(peer + ranks.rank());
    plan.peer.push_back({peer, out.size(), out.size() + n, expected.size(), expected.size() + n});
    out.insert(out.end(), n, 10 * ranks.rank() + peer);
    expected.insert(expected.end(), n, 10 * peer + ranks.rank());
  }
  std::vector<int> in(expected.size());
  const Traffic before = Ranks::traffic();
  ranks.exchange<int>(plan, out, in);
  EXPECT_EQ(in, expected);
  const Traffic after = Ranks::traffic();
  EXPECT_EQ(after.messages - before.messages, static_cast<std::int64_t>(plan.peer.size()));
  EXPECT_EQ(after.message_bytes - before.message_bytes,
            static_cast<std::int64_t>(out.size() * sizeof(int)));
}

TEST(Ranks, TheRootTellsTheOthers) {
  const Ranks ranks = Ranks::world();
  std::vector<int> values;
  if (ranks.is_root()) values = {7, 8, 9};
  ranks.broadcast(values);
  EXPECT_EQ(values, (std::vector<int>{7, 8, 9}));
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

}  // namespace
}  // namespace acinus
