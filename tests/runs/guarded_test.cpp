#include "runs/session/guarded.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <stdexcept>

#include "core/error.hpp"
#include "runs/session/together.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

TEST(Guarded, GivesTheExitCodeOfTheWork) {
  EXPECT_EQ(run_guarded("a.h5", [] { return 0; }), 0);
  EXPECT_EQ(run_guarded("a.h5", [] { return 75; }), 75);
  EXPECT_EQ(run_guarded("a.h5", []() -> int { throw Error("no"); }), 2);
  EXPECT_EQ(run_guarded("a.h5", []() -> int { throw Error("no", Exit::kFileError); }), 4);
  EXPECT_EQ(run_guarded("a.h5", []() -> int { throw std::runtime_error("no"); }), 1);
  EXPECT_EQ(run_guarded("a.h5", []() -> int { throw FailedElsewhere(3); }), 3);
  EXPECT_EQ(run_guarded("a.h5", []() -> int { throw 7; }), 1) << "no crash";
}

TEST(Guarded, ACrashIsADamagedFile) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    const auto crash = [&]() -> int {
      ::signal(signal, SIG_DFL);
      return raise(signal);
    };
    EXPECT_CONTAINS(test::message_of([&] { run_guarded("a.h5", crash); }, Exit::kFileError),
                    "a.h5: reading ended with signal");
  }
}

TEST(Guarded, PassesSignalsOn) {
  const pid_t parent = getpid();
  const auto work = [parent] {
    static volatile sig_atomic_t told = 0;
    ::signal(SIGTERM, [](int) { told = 1; });
    kill(parent, SIGTERM);
    for (int k = 0; k < 5000 && told == 0; ++k) usleep(1000);
    return told == 1 ? 75 : 1;
  };
  EXPECT_EQ(run_guarded("a.h5", work), 75);
}

}  // namespace
}  // namespace acinus::runs
