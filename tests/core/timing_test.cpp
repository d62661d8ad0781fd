#include "core/parallel/timing.hpp"

#include <gtest/gtest.h>

#include "core/parallel/clock.hpp"

namespace acinus {
namespace {

void burn(double seconds) {
  const double start = cpu_seconds();
  while (cpu_seconds() - start < seconds) {
  }
}

TEST(Timings, AccumulatesByNameInOrderOfFirstUse) {
  Timings timings;
  for (int step = 0; step < 3; ++step) {
    const auto outer = timings.scope("step");
    const auto inner = timings.scope("solve");
    burn(2e-3);
  }
  ASSERT_EQ(timings.stages().size(), 2u);
  EXPECT_EQ(timings.stages()[0].name, "step");
  const StageTime solve = timings.stage("solve"), step = timings.stage("step");
  EXPECT_EQ(solve.calls, 3u);
  // The clocks are read one after another, a few us apart.
  EXPECT_GE(solve.cpu, 6e-3 - 1e-4);
  EXPECT_GE(solve.wall, 6e-3 - 1e-4);
  EXPECT_GE(step.wall, solve.wall);
  EXPECT_EQ(timings.stage("absent").calls, 0u);
}

TEST(Timings, ClearWhileAScopeIsOpenIsHarmless) {
  Timings timings;
  {
    const auto scope = timings.scope("step");
    timings.clear();
  }
  EXPECT_TRUE(timings.stages().empty());
}

}  // namespace
}  // namespace acinus
