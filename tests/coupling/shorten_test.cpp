/// Steps that take part of a computed displacement.

#include "coupling/step/shorten.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "coupling/step/controller.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Limit of the displacement of a sphere of radius 12 um, um.
const double kLimit = move_limit(0.3, kSphereEdge * 12);

/// Friction of a sphere of radius 12 um with the medium, nN s/um.
const double kFriction = 0.5 * 4 * kPi * 144;

World with_limit(World w, double max_move = 0.3) {
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 100;  // the error estimate is tested elsewhere
  w.params.numerics.max_move = max_move;
  w.params.numerics.cg = {1e-12, 20000};
  return w;
}

/// Sphere that a constant force would move by `limits` limits in a step of 60 s.
World pulled_sphere(double limits) {
  return with_limit(
      make_test_world({{Vec3::Zero(), false, Vec3(limits * kLimit * kFriction / 60, 0, 0)}}));
}

StepResult take_minute(World& w) {
  SizedWorkspace work(w);
  const StepResult step = take_step(w, work, 60);
  EXPECT_TRUE(step.accepted) << step.cause;
  return step;
}

TEST(Shorten, TakesThePartOfAStepThatTheLimitOfMotionAllows) {
  World w = pulled_sphere(4);
  const StepResult step = take_minute(w);
  EXPECT_EQ(step.rejections, 0);
  EXPECT_EQ(w.state.clock.solves, 1);
  EXPECT_EQ(w.state.clock.shortened, 1);
  EXPECT_NEAR(step.step, 60 * 0.95 / 4, 1e-9);
  EXPECT_EQ(w.state.clock.time, step.step);
  // The velocity is constant, so that the place is exact.
  EXPECT_NEAR(cbm::center_of(w.state.cbm, 0).x(), 0.95 * kLimit, 1e-9);
}

TEST(Shorten, ComputesAShorterStepWhereThePartIsTooSmall) {
  World w = pulled_sphere(20);
  const StepResult step = take_minute(w);
  EXPECT_EQ(step.rejections, 1);
  EXPECT_NEAR(step.step, 60 * 0.95 / 20, 1e-9);
}

TEST(Shorten, NotWhereTheRandomForceChangesWithinTheStep) {
  for (const double grid : {600.0, 7.0}) {
    World w = pulled_sphere(4);
    w.params.motility.random = true;
    w.params.motility.grid = grid;
    const StepResult step = take_minute(w);
    EXPECT_EQ(w.state.clock.shortened, grid > 60 ? 1 : 0);
    EXPECT_EQ(step.rejections > 0, grid < 60);
  }
}

/// Two cells that overlap and push each other apart for two minutes.
double gap_of_pair(bool deformable, double max_move, double most,
                   std::int64_t* shortened = nullptr) {
  const double d = deformable ? 11.3 : 8;
  World w = with_limit(
      make_test_world({{Vec3(-d, 0, 0), deformable}, {Vec3(d, 0, 0), deformable}}, most), max_move);
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, 120));
  if (shortened != nullptr) *shortened = w.state.clock.shortened;
  const State& s = w.state;
  return deformable ? dcm::cell_center(s.dcm, 1).x() - dcm::cell_center(s.dcm, 0).x()
                    : (cbm::center_of(s.cbm, 1) - cbm::center_of(s.cbm, 0)).x();
}

TEST(Shorten, ErrsLessTheLowerTheLimit) {
  for (const bool deformable : {false, true}) {
    const double exact = gap_of_pair(deformable, 0, 0.1);
    double last = std::abs(gap_of_pair(deformable, 0, 60) - exact);
    std::printf("distance %.4f um; error of steps of 60 s %.4f um", exact, last);
    for (const double limit : {0.03, 0.0075}) {
      std::int64_t shortened = 0;
      const double error = std::abs(gap_of_pair(deformable, limit, 60, &shortened) - exact);
      std::printf(", %.4f um with %d shortened", error, static_cast<int>(shortened));
      EXPECT_GT(shortened, 0);
      EXPECT_LT(error, last);
      last = error;
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace acinus::coupling
