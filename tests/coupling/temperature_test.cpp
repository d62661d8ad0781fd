/// Temperature, beams and active tension that change while cells are stepped.

#include "coupling/apparatus/temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

World cell_in_beams() {
  World w = make_test_world({{Vec3(1, 2, 3), true, Vec3::Zero(), 8.8}}, 0.03, 42);
  w.params.dcm[0].viscosity = 1e-6;
  w.params.motility.random = false;
  w.params.stretcher.beams.power = 1.1e15;
  w.params.stretcher.pulse = {{0.1, 0.31}, {0.4, 0.5}};
  w.params.temperature.course.entry = {{0.1, 315}, {0.31, 310}, {0.31, 290}};
  return w;
}

TEST(Temperature, WarmthIsTheSameAsLessFriction) {
  for (const double series : {0.0, 3.0}) {
    World warm = cell_in_beams(), soft = warm;
    warm.params.dcm[0].series_friction = soft.params.dcm[0].series_friction = series;
    warm.params.temperature.course.entry = {{0, 305}};
    const double factor = friction_factor(warm.params.temperature, 0);
    EXPECT_LT(factor, 0.5);
    soft.params.temperature = {};
    soft.params.dcm[0].nodal_friction *= factor;
    soft.params.dcm[0].series_friction *= factor;
    const std::uint64_t before = hash_state(warm.state);
    Simulation a(warm), b(soft);
    EXPECT_TRUE(a.run_until(1, {}).ok);
    EXPECT_TRUE(b.run_until(1, {}).ok);
    EXPECT_EQ(hash_state(a.world().state), hash_state(b.world().state));
    EXPECT_NE(hash_state(a.world().state), before);
  }
}

// A step across a switch would mix what is before with what is after.
TEST(Stretcher, StepsEndWhereBeamsOrTemperatureChange) {
  Simulation s(cell_in_beams());
  std::vector<double> ends;
  Observer watch;
  watch.step = [&](const StepResult&) { ends.push_back(s.time()); };
  EXPECT_TRUE(s.run_until(0.6, watch).ok);
  for (const double change : {0.1, 0.31, 0.4, 0.5}) {
    double nearest = 1;
    for (const double t : ends) nearest = std::min(nearest, std::abs(t - change));
    EXPECT_LT(nearest, 1e-12) << change;
  }
}

/// A cell whose tension rises, jumps and stays.
World contracting_cell() {
  World w = make_test_world({{Vec3(1, 2, 3)}}, 7, 42);
  w.params.motility.random = false;
  w.params.dcm[0].cortex_tension = 0.1;
  w.params.dcm[0].contraction = dcm::Contraction{};
  w.params.dcm[0].contraction->course.entry = {{20, 1}, {50, 2}, {50, 3}};
  return w;
}

TEST(Contraction, StepsEndAtTheCornersOfItsCourse) {
  Simulation s(contracting_cell());
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
  World course = contracting_cell(), constant = course;
  course.params.dcm[0].contraction->course.entry = {{0, 1.5}};
  constant.params.dcm[0].contraction.reset();
  constant.params.dcm[0].cortex_tension *= 1.5;
  Simulation a(course), b(constant);
  EXPECT_TRUE(a.run_until(60, {}).ok);
  EXPECT_TRUE(b.run_until(60, {}).ok);
  EXPECT_EQ(hash_state(a.world().state), hash_state(b.world().state));
}

// A ring makes a waist: the cell is longer along the axis than across.
TEST(Contraction, ARingMakesAWaist) {
  World w = contracting_cell();
  w.params.dcm[0].contraction->course.entry.clear();
  w.params.dcm[0].contraction->ring = 3;
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

TEST(Stretcher, PullsWhileItShinesOnly) {
  const Stretcher s = cell_in_beams().params.stretcher;
  for (const double on : {0.1, 0.2, 0.4}) EXPECT_GT(stretch_at(s, on).stress, 0) << on;
  for (const double off : {0.0, 0.31, 0.5, 9.0}) EXPECT_EQ(stretch_at(s, off).stress, 0) << off;
}

}  // namespace
}  // namespace acinus::coupling
