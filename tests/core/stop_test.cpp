#include "core/parallel/stop.hpp"

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
    EXPECT_EQ(describe_stop(), "signal " + std::to_string(SIGUSR1) + " (SIGUSR1)");
    EXPECT_EQ(count_stop_signals(), 1);
  }
  EXPECT_FALSE(stop_requested());
  EXPECT_EQ(describe_stop(), "");
}

void (*handler_of(int signal))(int) {
  struct sigaction set {};
  sigaction(signal, nullptr, &set);
  return set.sa_handler;
}

TEST(Stop, EverySignalAsksAndGetsBackWhatWasSet) {
  int sent = 0;
  {
    const StopSignals counted;
    for (const int signal : stop_signals()) {
      std::raise(signal);
      EXPECT_EQ(count_stop_signals(), ++sent) << signal;
    }
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP})
      EXPECT_EQ(handler_of(crash), SIG_DFL) << crash;
  }
  for (const int signal : stop_signals()) EXPECT_EQ(handler_of(signal), SIG_DFL) << signal;
}

TEST(Stop, WhatWasIgnoredStaysIgnoredButForTheKeyboard) {
  for (const int signal : stop_signals()) std::signal(signal, SIG_IGN);
  {
    const StopSignals counted;
    for (const int signal : stop_signals()) {
      const int before = count_stop_signals();
      std::raise(signal);
      EXPECT_EQ(count_stop_signals() > before, signal == SIGINT || signal == SIGQUIT) << signal;
    }
  }
  for (const int signal : stop_signals()) {
    EXPECT_EQ(handler_of(signal), SIG_IGN) << signal;
    std::signal(signal, SIG_DFL);
  }
}

void somebody_elses(int) {}

TEST(Stop, AProfilersHandlerStays) {
  std::signal(SIGPROF, somebody_elses);
  std::signal(SIGINT, somebody_elses);
  {
    const StopSignals counted;
    EXPECT_EQ(handler_of(SIGPROF), somebody_elses);
    EXPECT_NE(handler_of(SIGINT), somebody_elses) << "Python's would come too late";
  }
  EXPECT_EQ(handler_of(SIGINT), somebody_elses);
  for (const int signal : {SIGPROF, SIGINT}) std::signal(signal, SIG_DFL);
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

TEST(StopDeathTest, ThePreparationOfARunEndsAtTheLimitAndAtSignals) {
  EXPECT_EXIT(
      {
        const WallTimeLimit limit(0.05);
        const ExitAtLimit nothing_to_save;
        for (;;) pause();
      },
      testing::ExitedWithCode(75), "stopped by the wall-time limit");
  for (const int signal : {SIGHUP, SIGTERM, SIGXCPU, SIGALRM})
    EXPECT_EXIT(
        {
          const ExitAtSignal nothing_to_save;
          std::raise(signal);
        },
        testing::ExitedWithCode(75), "stopped by SIG[A-Z]+ while a run was prepared");
  EXPECT_EXIT(
      {
        const ExitAtSignal nothing_to_save;
        {
          const StopSignals counted;
          std::raise(SIGHUP);
        }
        std::raise(SIGHUP);
      },
      testing::ExitedWithCode(75), "SIGHUP");
  const ExitAtLimit without;  // no limit, no alarm
  EXPECT_EQ(alarm(0), 0u);
}

}  // namespace
}  // namespace acinus
