/// Spheres that meet a pipette.

#include <gtest/gtest.h>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

contact::Pipette tube(double radius) {
  contact::Pipette p;
  p.name = "pipette";
  p.radius = radius;
  p.thickness = 60;
  p.lip = 2;
  p.length = 40;
  return p;
}

World sphere_at(const Vec3& center, const Vec3& pull, double radius) {
  World w = make_test_world({{center, false, pull, radius}}, 10);
  w.params.motility.random = false;
  w.params.numerics.cg.tolerance = 1e-10;
  return w;
}

Vec3 place_after(const World& world, double time) {
  Simulation s(world);
  EXPECT_TRUE(s.run_until(time, {}).ok);
  return cbm::center_of(s.world().state.cbm, 0);
}

// Away from its rims the end of a tube is a plane.
TEST(SphereAtAPipette, MeetsItsFlatEndAsAWall) {
  const World free = sphere_at(Vec3(40, 3, -13), Vec3(0, 0, 1), 12);
  World at_tube = free, at_wall = free;
  at_tube.params.boundary.pipettes = {tube(10)};
  contact::Plane plane;
  plane.normal = -Vec3::UnitZ();
  plane.material = {};
  at_wall.params.boundary.planes = {plane};
  const Vec3 end = place_after(at_tube, 20000);
  EXPECT_NEAR((end - place_after(at_wall, 20000)).norm(), 0, 1e-9);
  EXPECT_GT(end.z(), -12) << "pressed in";
  EXPECT_LT(end.z(), -11);
}

TEST(SphereAtAPipette, GoesThroughATubeWiderThanItself) {
  World w = sphere_at(Vec3(0.5, 0, -13), Vec3(0, 0, 1), 8);
  w.params.boundary.pipettes = {tube(10)};
  const Vec3 end = place_after(w, 40000);
  EXPECT_GT(end.z(), 60);
  EXPECT_LT(std::hypot(end.x(), end.y()), 2.1);
}

// The sphere touches the rim on all sides at once, of which the law sees the nearest: it stays
// before the hole, and does not go through.
TEST(SphereAtAPipette, StaysBeforeAHoleNarrowerThanItself) {
  for (const Vec3& start : {Vec3(0, 0, -14), Vec3(0.7, -0.3, -14)}) {
    World w = sphere_at(start, Vec3(0, 0, 0.3), 12);
    w.params.boundary.pipettes = {tube(8)};
    const Vec3 end = place_after(w, 20000);
    EXPECT_LT(end.z(), 0) << start.transpose();
    EXPECT_GT(end.z(), -14);
    EXPECT_LT(std::hypot(end.x(), end.y()), 1.5) << start.transpose();
  }
}

}  // namespace
}  // namespace acinus::coupling
