#include "core/stop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <limits>
#include <thread>

namespace acinus {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

TEST(Stop, ASignalAsksWhileSomeoneCounts) {
  {
    const StopSignals outer;
    EXPECT_FALSE(stop_requested());
    {
      const StopSignals inner;
      std::raise(SIGUSR1);
      EXPECT_TRUE(stop_requested());
    }
    EXPECT_TRUE(stop_requested()) << "the outer one was asked too";
    EXPECT_EQ(describe_stop(), "signal " + std::to_string(SIGUSR1));
    EXPECT_EQ(count_stop_signals(), 1);
  }
  EXPECT_FALSE(stop_requested());
  EXPECT_EQ(describe_stop(), "");
}

TEST(Stop, TheEarliestLimitCounts) {
  const WallTimeLimit none(kNone);
  EXPECT_FALSE(stop_requested());
  {
    const WallTimeLimit passed(0);
    const WallTimeLimit later(1000);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(stop_requested());
    EXPECT_EQ(describe_stop(), "the wall-time limit");
  }
  EXPECT_FALSE(stop_requested());
}

TEST(StopDeathTest, ThePreparationOfARunEndsAtTheLimit) {
  EXPECT_EXIT(
      {
        const WallTimeLimit limit(0.05);
        const ExitAtLimit nothing_to_save;
        for (;;) pause();
      },
      testing::ExitedWithCode(75), "stopped by the wall-time limit");
  const ExitAtLimit without;  // no limit, no alarm
  EXPECT_EQ(alarm(0), 0u);
}

}  // namespace
}  // namespace acinus
