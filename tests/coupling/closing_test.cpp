/// Contacts that close within a step are felt in that step.

#include "coupling/step/active_set.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "coupling/step/controller.hpp"
#include "coupling/step/linearisation.hpp"
#include "coupling/step/solve.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Shell just above a wall, pulled down so fast that a step of a minute would carry it through.
World falling_cell(Integrator integrator) {
  World w = make_test_world({{Vec3(0, 0, 12.3), true, Vec3(0, 0, -3)}}, 60, 162);
  contact::Plane floor;
  floor.material.mirror = true;
  w.params.boundary.planes = {floor};
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 10;  // the error estimate is not tested here
  w.params.numerics.cg = {1e-10, 20000};
  w.params.numerics.integrator = integrator;
  return w;
}

double lowest(const World& w) {
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, 0, node);
  double z = node.front().z();
  for (const Vec3& x : node) z = std::min(z, x.z());
  return z;
}

TEST(Closing, AStepStopsAtAWallItWouldHavePassed) {
  World w = falling_cell(Integrator::kLinearlyImplicit);
  const double free_fall = 60 * 3 / (0.1 * geometry::shared_icosphere(162).rest_area * 144);
  ASSERT_GT(free_fall, 0.3 + kControlledDepth) << "else there is nothing to see";
  SizedWorkspace work(w);
  const StepResult step = take_step(w, work, 60);
  ASSERT_TRUE(step.accepted);
  std::printf("falls %.2f um freely, stands at %.4f um\n", free_fall, lowest(w));
  EXPECT_EQ(step.rejections, 0);
  EXPECT_EQ(step.step, 60);
  EXPECT_GT(w.state.clock.solves, 1);
  // What holds 3 nN in the wall: a few nodes of 11 um^2 at 5 nN/um^3.
  EXPECT_GT(lowest(w), -3 / (5 * 9.8));
  EXPECT_LT(lowest(w), 0.05);
}

/// Positions of all points after one step.
std::vector<double> step_once(World w) {
  SizedWorkspace work(w);
  EXPECT_TRUE(take_step(w, work, 60).accepted);
  std::printf("lowest %.4f um, centre %.4f um\n", lowest(w), dcm::cell_center(w.state.dcm, 0).z());
  return gather_positions(w.state);
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size() / kLanes));
}

TEST(Closing, EndsNearerToBackwardEulerThanAPlainStep) {
  World solved = falling_cell(Integrator::kNewton);
  solved.params.numerics.adaptive = false;  // from the plain step, to the end
  solved.params.numerics.tolerance = 1e-3;
  World plain = falling_cell(Integrator::kLinearlyImplicit);
  plain.params.numerics.adaptive = false;
  const auto truth = step_once(solved), without = step_once(plain),
             with = step_once(falling_cell(Integrator::kLinearlyImplicit));
  std::printf("off the solved equation: %.3f um, without %.3f um\n", rms(with, truth),
              rms(without, truth));
  // What is left is the shape, still linearised at the start.
  EXPECT_LT(rms(with, truth), 0.25 * rms(without, truth));
}

TEST(Closing, DepthInASoftVesselIsALoadAndNoReasonForAShorterStep) {
  // 15 nN on a wall of 600 Pa: the surface stands deeper than kControlledDepth at rest. Points that
  // guard against thin vessels push deeper still and are not on their branch on the way there.
  World w = make_test_world({{Vec3(0, 0, 12 + 4.7 + 0.05), true, Vec3(0, 0, -15)}}, 60, 162);
  geometry::Network n;
  n.node = {{-30, 0, 0}, {30, 0, 0}};
  n.segment = {{0, 1}};
  n.radius = {{4.7, 4.7}};
  contact::set_network(w.params.boundary.vessels, n);
  w.params.boundary.vessels.material = {0, 0.6, 0.4, false};
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 10;
  SizedWorkspace work(w);
  int rejections = 0;
  for (int step = 0; step < 20; ++step) {
    const StepResult result = take_step(w, work, 6);
    ASSERT_TRUE(result.accepted) << result.cause;
    rejections += result.rejections;
  }
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, 0, node);
  double depth = 0;
  for (const Vec3& x : node)
    depth = std::max(depth, -contact::gap_to_segment(w.params.boundary.vessels.network, 0, x).gap);
  std::printf("%.3f um deep, %d rejections\n", depth, rejections);
  EXPECT_GT(depth, kControlledDepth) << "else there is nothing to see";
  EXPECT_EQ(rejections, 0);
}

TEST(Closing, LeavesStepsAloneThatStayClear) {
  World w = falling_cell(Integrator::kLinearlyImplicit);
  w.state.dcm.pull[0] = Vec3(0, 0, -0.3);
  SizedWorkspace work(w);
  ASSERT_TRUE(take_step(w, work, 60).accepted);
  EXPECT_EQ(w.state.clock.solves, 1);
}

/// Two shells, 0.4 um apart, that pulls would carry through each other in a minute.
World approaching_cells() {
  World w = make_test_world(
      {{Vec3(-12.2, 0, 0), true, Vec3(2, 0, 0)}, {Vec3(12.2, 0, 0), true, Vec3(-2, 0, 0)}});
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 10;
  w.params.numerics.cg = {1e-12, 20000};
  return w;
}

/// Updates the active set in the middle of a step of a minute, and compares the residual with that
/// of the new matrix.
void compare_residuals(const World& w, Workspace& work) {
  Effort effort;
  const State& at = choose_linearisation_point(w, 60, true, work);
  assemble(w, at, 60, work, {});
  ASSERT_TRUE(solve_step(w, 60, work, effort).ok);
  ASSERT_TRUE(activate_closing(work));
  work.op.prepare(work.system);
  RowVector<double> from_point(work.move.size()), product(work.move.size());
  const LinearisationPoint& point = work.linearisation;
  for (std::size_t k = 0; k < from_point.size(); ++k)
    from_point[k] = work.move[k] - (point.is_elsewhere() ? point.move[k] : 0);
  work.op.apply(from_point, product);
  double largest = 0, load = 0, difference = 0;
  for (std::size_t k = 0; k < product.size(); ++k) {
    largest = std::max(largest, std::abs(work.cg.residual[k]));
    load = std::max(load, std::abs(work.rhs[k] + product[k]));
    difference = std::max(difference, std::abs(work.cg.residual[k] - (work.rhs[k] - product[k])));
  }
  std::printf("residual %.3g nN of %.3g nN, %.3g nN off\n", largest, load, difference);
  EXPECT_GT(largest, 0.01 * load) << "else there is nothing to see";
  EXPECT_LT(difference, 1e-10 * load);
  ASSERT_TRUE(solve_again(w, work, effort).ok);
  for (std::size_t k = 0; k < from_point.size(); ++k)
    from_point[k] = work.move[k] - (point.is_elsewhere() ? point.move[k] : 0);
  work.op.apply(from_point, product);
  for (std::size_t k = 0; k < product.size(); ++k)
    EXPECT_NEAR(product[k], work.rhs[k], 1e-8 * load);
}

TEST(Closing, UpdatesTheResidualOfAStepFromRest) {
  const World w = approaching_cells();
  SizedWorkspace work(w);
  compare_residuals(w, work);
  EXPECT_FALSE(work.linearisation.is_elsewhere());
}

TEST(Closing, UpdatesTheResidualOfAnExtrapolatedStep) {
  World w = approaching_cells();
  w.params.dcm[0].adhesion = 0;  // else they hold each other after the first step
  w.params.dcm_contact.cell_friction = 0;
  w.params.numerics.extrapolate = true;
  SizedWorkspace work(w);
  ASSERT_TRUE(take_step(w, work, 6).accepted);
  compare_residuals(w, work);
  EXPECT_TRUE(work.linearisation.is_elsewhere());
}

TEST(Closing, BetweenCellsKeepsTheBalanceOfForces) {
  World w = approaching_cells();
  w.params.dcm[0].adhesion = 0;
  w.params.dcm_contact.cell_friction = 0;
  SizedWorkspace work(w);
  const StepResult step = take_step(w, work, 60);
  ASSERT_TRUE(step.accepted) << step.cause;
  EXPECT_EQ(step.rejections, 0);
  EXPECT_GT(w.state.clock.solves, 1);
  EXPECT_LT(w.state.balance.momentum, 1e-9);
}

}  // namespace
}  // namespace acinus::coupling
