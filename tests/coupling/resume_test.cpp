/// Going on from a saved State must give the bits of the run that was never stopped, whatever the
/// scratch of that run held.

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/stop.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr int kSteps = 12;
constexpr double kLongStep = 240;  ///< s

/// Eight cells of both models; a tight solve of long steps in packed cells, so that the coarse
/// space comes on.
World packed_cells(Integrator integrator) {
  World w = make_test_world(checkered_cube(23.5), kLongStep, 42);
  w.params.motility.random = true;
  w.params.numerics.cg = {1e-8, 20000};
  w.params.numerics.integrator = integrator;
  return w;
}

/// Takes a number of steps; returns how many were taken with the coarse space on, -1 if one failed.
int take_steps(World& w, Workspace& work, int n) {
  int with_coarse = 0;
  for (int k = 0; k < n; ++k) {
    with_coarse += w.state.clock.coarse ? 1 : 0;
    const StepResult result = take_step(w, work, kLongStep);
    if (!result.accepted) {
      std::printf("step %d failed: %s\n", k, result.cause.c_str());
      return -1;
    }
  }
  return with_coarse;
}

class Resume : public testing::TestWithParam<Integrator> {};

TEST_P(Resume, IsBitForBitWithTheCoarseSpaceOn) {
  World through = packed_cells(GetParam());
  SizedWorkspace work(through);
  const int first = take_steps(through, work, kSteps / 2);
  ASSERT_GE(first, 0);
  ASSERT_TRUE(through.state.clock.coarse) << "the scene is too easy for this test";
  const State saved = through.state;
  const int second = take_steps(through, work, kSteps / 2);
  std::printf("%d of the steps before and %d of the %d after saving had the coarse space on\n",
              first, second, kSteps / 2);
  EXPECT_GT(second, 0);

  World resumed = packed_cells(GetParam());
  resumed.state = saved;
  SizedWorkspace fresh(resumed);
  EXPECT_EQ(take_steps(resumed, fresh, kSteps / 2), second);
  EXPECT_EQ(hash_state(resumed.state), hash_state(through.state));
  EXPECT_EQ(resumed.state.clock.cg_iterations, through.state.clock.cg_iterations);
  EXPECT_EQ(resumed.state.clock.solves, through.state.clock.solves);
  EXPECT_EQ(resumed.state.clock.coarse, through.state.clock.coarse);

  // It would not be so if the clock did not hold whether the coarse space is on.
  World forgetful = packed_cells(GetParam());
  forgetful.state = saved;
  forgetful.state.clock.coarse = false;
  SizedWorkspace other(forgetful);
  EXPECT_GE(take_steps(forgetful, other, kSteps / 2), 0);
  EXPECT_NE(hash_state(forgetful.state), hash_state(through.state));
}

TEST_P(Resume, AStepThatIsInterruptedChangesNothing) {
  World through = packed_cells(GetParam());
  SizedWorkspace work(through);
  ASSERT_GE(take_steps(through, work, 2), 0);
  World stopped = packed_cells(GetParam());
  stopped.state = through.state;
  SizedWorkspace other(stopped);
  {
    const WallTimeLimit passed(0);
    const StepResult result = take_step(stopped, other, kLongStep);
    EXPECT_FALSE(result.accepted);
    EXPECT_TRUE(result.interrupted);
  }
  EXPECT_EQ(hash_state(stopped.state), hash_state(through.state));
  ASSERT_GE(take_steps(through, work, 1), 0);
  ASSERT_GE(take_steps(stopped, other, 1), 0);
  EXPECT_EQ(hash_state(stopped.state), hash_state(through.state));
  EXPECT_EQ(stopped.state.clock.rejected, through.state.clock.rejected);
}

// The law of triangles, with lists of triangles as old as they may be at the time of saving.
TEST(ResumeTriangles, IsBitForBit) {
  const auto make = [] {
    World w = packed_cells(Integrator::kLinearlyImplicit);
    w.params.dcm_contact.law = dcm::ContactLaw::kMaugisDugdale;
    return w;
  };
  constexpr double kShortStep = 10;  ///< s
  const auto take = [](World& w, Workspace& work) {
    for (int k = 0; k < kSteps / 2; ++k) {
      const StepResult result = take_step(w, work, kShortStep);
      ASSERT_TRUE(result.accepted) << result.cause;
    }
  };
  World through = make();
  SizedWorkspace work(through);
  take(through, work);
  World resumed = make();
  resumed.state = through.state;
  take(through, work);
  SizedWorkspace fresh(resumed);
  take(resumed, fresh);
  EXPECT_EQ(hash_state(resumed.state), hash_state(through.state));
  EXPECT_FALSE(work.contacts.interface().empty());
}

INSTANTIATE_TEST_SUITE_P(Integrators, Resume,
                         testing::Values(Integrator::kLinearlyImplicit, Integrator::kNewton));

}  // namespace
}  // namespace acinus::coupling
