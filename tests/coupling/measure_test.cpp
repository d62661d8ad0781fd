/// What a run reports of each cell.

#include "coupling/measure/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

struct Observed {
  World world;
  Workspace work;
  std::vector<CellMeasure> cell;
  explicit Observed(World w) : world(std::move(w)) {
    size_workspace(world, work);
    observe(world, work);
    cell = measure_cells(world, work);
  }
};

TEST(ContactForce, OfACellBetweenTwoIsTheSumOfBoth) {
  const Observed o(
      make_test_world({{Vec3(-22, 0, 0), false}, {Vec3::Zero(), false}, {Vec3(0, 23, 0), false}}));
  double left = 0, top = 0;
  for (const contact::Contact& c : o.work.contacts.sphere()) {
    if (std::min(c.a, c.b) == 0 && std::max(c.a, c.b) == 1) left = std::abs(c.force);
    if (std::min(c.a, c.b) == 1 && std::max(c.a, c.b) == 2) top = std::abs(c.force);
  }
  EXPECT_GT(left, 0);
  EXPECT_GT(top, 0);
  // The same numbers, up to the length of the normal.
  EXPECT_NEAR(o.cell[0].contact_force, left, 1e-12 * left);
  EXPECT_NEAR(o.cell[1].contact_force, left + top, 1e-12 * (left + top));
  EXPECT_NEAR(o.cell[2].contact_force, top, 1e-12 * top);
  EXPECT_EQ(o.cell[1].contacts, 2);
}

TEST(ContactForce, IsTheSameOnBothModelsAndWhatTheSphereFeels) {
  const Observed o(make_test_world({{Vec3::Zero(), true}, {Vec3(22.5, 2, 1), false}}));
  ASSERT_EQ(o.cell.size(), 2U);
  const Address sphere = cbm::cell_address(cbm_first_row(o.world.state), 0);
  const double felt = load_point(o.work.system.force.data(), sphere).norm();
  EXPECT_GT(felt, 0);
  EXPECT_EQ(o.cell[0].contact_force, o.cell[1].contact_force);
  // The solver keeps weights of links in single precision.
  EXPECT_NEAR(o.cell[1].contact_force, felt, 1e-6 * felt);
}

TEST(ContactForce, OfTwoDeformableCellsIsTheSame) {
  const Observed o(make_test_world({{Vec3::Zero(), true}, {Vec3(23, 1, 0), true}}));
  EXPECT_GT(o.cell[0].contact_force, 0);
  EXPECT_EQ(o.cell[0].contact_force, o.cell[1].contact_force);
  EXPECT_EQ(o.cell[0].contacts, 1);
}

TEST(ContactForce, CountsTheWholeBoundaryAsOnePartner) {
  // In a corner of two equal walls: the resultant is sqrt 2 times the force of one.
  World world = make_test_world({{Vec3(11.5, 11.5, 0), false}});
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    contact::Plane plane;
    plane.normal = normal;
    plane.material.mirror = true;
    world.params.boundary.planes.push_back(plane);
  }
  const Observed both(world);
  world.params.boundary.planes.pop_back();
  world.state.cbm.position = both.world.state.cbm.position;
  const Observed one(world);
  EXPECT_GT(one.cell[0].contact_force, 0);
  // The force also depends on how compressed a sphere is, which is a little more between two walls.
  EXPECT_GE(both.cell[0].contact_force, std::sqrt(2.0) * one.cell[0].contact_force * (1 - 1e-12));
  EXPECT_LT(both.cell[0].contact_force, 2 * one.cell[0].contact_force);
  EXPECT_EQ(both.cell[0].contacts, 0);
}

}  // namespace
}  // namespace acinus::coupling
