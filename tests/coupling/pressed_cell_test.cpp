/// Deformable cell pressed against spheres and into the available volume between them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "coupling/measure/measure.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Deformable cell and two spheres, ten times as stiff, in a capsule that shrinks to 16 um.
World pressed_cell(bool extrapolate) {
  World w =
      make_test_world({{Vec3(-11.5, 0, 0)}, {Vec3(11.5, 0, 0), false}, {Vec3(0, 20, 0), false}});
  w.state.cbm.young.replace([](double young) { return 10 * young; });
  w.params.dcm[0].local_area_modulus = 0.1;
  contact::Capsule capsule;
  capsule.center = Vec3(0, 5, 0);
  capsule.radius = 27;
  capsule.speed = 4.0 / 3600;
  capsule.min_radius = 16;
  w.params.boundary.capsules = {capsule};
  w.params.numerics.adaptive = true;
  w.params.numerics.tolerance = 0.1;
  w.params.numerics.min_step = 0.01;
  w.params.numerics.extrapolate = extrapolate;
  w.state.clock.phase = Phase::kRun;
  return w;
}

/// Number of steps from 2.5 h to 3.5 h, at a cell pressure of some hundred Pa.
std::int64_t steps_under_pressure(bool extrapolate) {
  World w = pressed_cell(extrapolate);
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, 9000));
  const std::int64_t before = w.state.clock.accepted;
  EXPECT_TRUE(run_until(w, work, 12600));
  return w.state.clock.accepted - before;
}

TEST(LookAhead, DoesNotSwingABulgeBetweenSpheres) {
  const std::int64_t plain = steps_under_pressure(false), ahead = steps_under_pressure(true);
  std::printf("an hour takes %ld plain steps, %ld that look ahead\n", static_cast<long>(plain),
              static_cast<long>(ahead));
  // A swing shortens one step by half at most; those that follow are plain and half as long again
  // each, so that the third is as long as before: a mean of 3/4 at worst, of the step that swings
  // as well. Where every step looks ahead it is 6 times as many.
  EXPECT_LT(static_cast<double>(ahead), 2 * static_cast<double>(plain));
}

// The load of a sphere is the pressure of the cell on it and the tension of the indented surface.
// It is an elastic bed: the depth is this load over its stiffness. With a bed as wide as the area
// at rest of the cell the depth grew without limit, and the cell flowed through the spheres.
TEST(PressedCell, DentsASphereAsMuchAsItsPressureSays) {
  World w = pressed_cell(false);
  w.params.boundary.capsules[0].min_radius = 14.5;
  SizedWorkspace work(w);
  for (int k = 8; k <= 12; ++k) {  // lower pressures are drowned by adhesion and tension
    ASSERT_TRUE(run_until(w, work, 900.0 * k));
    double depth = 0;
    for (const contact::Contact& c : work.contacts.interface()) depth = std::max(depth, -c.gap);
    const cbm::Params& p = w.params.cbm[0];
    const double young = w.state.cbm.young[0];
    const double bed = compute_compliance(w.params.dcm_contact.repulsion,
                                          {12, young, p.poisson, {young, 0}, nullptr}, depth)
                           .stiffness;
    const double pressure = measure_cells(w, work).front().cytosol_pressure;
    std::printf("%.2f h: pressure %.0f Pa, deepest dent %.2f um, of its bed %.0f Pa\n", k / 4.0,
                1e3 * pressure, depth, 1e3 * bed * depth);
    // The mean over a round indentation is half of the largest load of the bed; tension adds 2 T/R,
    // some 50 Pa.
    EXPECT_LT(bed * depth, 2 * pressure + 0.1);
  }
}

}  // namespace
}  // namespace acinus::coupling
