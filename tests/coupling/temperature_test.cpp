/// Temperature and beams that change while cells are stepped.

#include "coupling/apparatus/temperature/temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "coupling/apparatus/stretcher/stretcher.hpp"
#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

Stretcher make_beams() {
  Stretcher s;
  s.beams.power = 1.1e15;
  s.pulse = {{0.1, 0.31}, {0.4, 0.5}};
  return s;
}

Temperature make_temperature(std::vector<Schedule::Point> course) {
  Temperature t;
  t.course.entry = std::move(course);
  return t;
}

World cell_in_beams() {
  World w = make_test_world({{Vec3(1, 2, 3), true, Vec3::Zero(), 8.8}}, 0.03, 42);
  w.params.dcm[0].viscosity = 1e-6;
  w.params.motility.random = false;
  w.params.apparatus.add(make_beams());
  return w;
}

TEST(Temperature, WarmthIsTheSameAsLessFriction) {
  for (const double series : {0.0, 3.0}) {
    World warm = cell_in_beams(), soft = warm;
    warm.params.dcm[0].series_friction = soft.params.dcm[0].series_friction = series;
    warm.params.apparatus.add(make_temperature({{0, 305}}));
    const double factor = warm.params.apparatus.get<Temperature>().friction_factor(0);
    EXPECT_LT(factor, 0.5);
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
  World w = cell_in_beams();
  w.params.apparatus.add(make_temperature({{0.1, 315}, {0.31, 310}, {0.35, 290}}));
  Simulation s(w);
  std::vector<double> ends;
  Observer watch;
  watch.step = [&](const StepResult&) { ends.push_back(s.time()); };
  EXPECT_TRUE(s.run_until(0.6, watch).ok);
  for (const double change : {0.1, 0.31, 0.35, 0.4, 0.5}) {
    double nearest = 1;
    for (const double t : ends) nearest = std::min(nearest, std::abs(t - change));
    EXPECT_LT(nearest, 1e-12) << change;
  }
}

TEST(Stretcher, PullsWhileItShinesOnly) {
  const Stretcher s = make_beams();
  for (const double on : {0.1, 0.2, 0.4}) EXPECT_GT(s.load_at(on).stress, 0) << on;
  for (const double off : {0.0, 0.31, 0.5, 9.0}) EXPECT_EQ(s.load_at(off).stress, 0) << off;
}

}  // namespace
}  // namespace acinus::coupling
