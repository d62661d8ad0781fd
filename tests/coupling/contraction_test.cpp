/// Active tension that changes while cells are stepped, and its ring.

#include "coupling/apparatus/contraction/contraction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Cell whose tension follows a course.
World contracting_cell(std::vector<Schedule::Point> course) {
  World w = make_test_world({{Vec3(1, 2, 3)}}, 7, 42);
  w.params.motility.random = false;
  w.params.dcm[0].cortex_tension = 0.1;
  Contraction contraction;
  contraction.course.resize(1);
  contraction.course[0].entry = std::move(course);
  w.params.apparatus.add(std::move(contraction));
  return w;
}

TEST(Contraction, StepsEndAtTheCornersOfItsCourse) {
  Simulation s(contracting_cell({{20, 1}, {50, 2}, {50, 3}}));
  std::vector<double> ends;
  Observer watch;
  watch.step = [&](const StepResult&) { ends.push_back(s.time()); };
  EXPECT_TRUE(s.run_until(100, watch).ok);
  for (const double change : {20.0, 50.0}) {
    double nearest = 100;
    for (const double t : ends) nearest = std::min(nearest, std::abs(t - change));
    EXPECT_LT(nearest, 1e-9) << change;
  }
}

TEST(Contraction, IsTheSameAsThatMuchTension) {
  World course = contracting_cell({{0, 1.5}}), constant = course;
  constant.params.apparatus = {};
  constant.params.dcm[0].cortex_tension *= 1.5;
  Simulation a(course), b(constant);
  EXPECT_TRUE(a.run_until(60, {}).ok);
  EXPECT_TRUE(b.run_until(60, {}).ok);
  EXPECT_EQ(hash_state(a.world().state), hash_state(b.world().state));
}

// A ring makes a waist: the cell is longer along the axis than across.
TEST(Contraction, ARingMakesAWaist) {
  World w = contracting_cell({});
  w.params.dcm[0].ring = dcm::ContractileRing{.excess = 3};
  Simulation s(w);
  ASSERT_TRUE(s.run_until(600, {}).ok);
  std::vector<Vec3> node;
  dcm::copy_nodes(s.world().state.dcm, 0, node);
  double along = 0, across = 0;
  for (const Vec3& x : node) {
    along = std::max(along, std::abs(x.z() - 3));
    across = std::max(across, std::hypot(x.x() - 1, x.y() - 2));
  }
  std::printf("half length %.2f um along the axis, %.2f um across\n", along, across);
  EXPECT_GT(along, 1.03 * across);
}

}  // namespace
}  // namespace acinus::coupling
