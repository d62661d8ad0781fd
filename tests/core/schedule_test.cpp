
#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers/arrhenius.hpp"
#include "core/numbers/schedule.hpp"

namespace acinus {
namespace {

TEST(Schedule, RunsStraightBetweenEntriesAndJumpsWhereTwoMeet) {
  const Schedule s{{{1, 10}, {3, 20}, {3, 5}, {4, 5}}};
  EXPECT_EQ(s.at(-7), 10);
  EXPECT_EQ(s.at(1), 10);
  EXPECT_EQ(s.at(2), 15);
  EXPECT_DOUBLE_EQ(s.at(3 - 1e-9), 20 - 5e-9);
  EXPECT_EQ(s.at(3), 5) << "the later entry";
  EXPECT_EQ(s.at(100), 5);
  EXPECT_EQ(s.next(0), 1);
  EXPECT_EQ(s.next(1), 3);
  EXPECT_EQ(s.next(3), 4);
  EXPECT_TRUE(std::isinf(s.next(4)));
}

TEST(Schedule, OfOneEntryIsConstant) {
  const Schedule s{{{2, 7}}};
  for (const double t : {0.0, 2.0, 9.0}) EXPECT_EQ(s.at(t), 7);
}

// The paper fits 0.29 and 0.11 at 310 and 315 K, from 290 K.
TEST(Arrhenius, FactorsOfThePaper) {
  EXPECT_NEAR(arrhenius_factor(55e18, 310, 290), 0.22953208, 1e-6);
  EXPECT_NEAR(arrhenius_factor(55e18, 315, 290), 0.16358215, 1e-6);
  EXPECT_NEAR(arrhenius_factor(55e18, 310, 290), 0.29, 0.0605);
  EXPECT_NEAR(arrhenius_factor(55e18, 315, 290), 0.11, 0.06);
  EXPECT_EQ(arrhenius_factor(55e18, 290, 290), 1);
}

}  // namespace
}  // namespace acinus
