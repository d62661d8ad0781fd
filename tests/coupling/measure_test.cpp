/// Measures of single cells.

#include "coupling/measure/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "coupling/measure/pair_contacts.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

struct Measured : Observed {
  explicit Measured(World w) : Observed(std::move(w)) {}
  std::vector<CellMeasure> cell = measure_cells(world, work);
};

TEST(ContactForce, OfACellBetweenTwoIsTheSumOfBoth) {
  const Measured o(
      make_test_world({{Vec3(-22, 0, 0), false}, {Vec3::Zero(), false}, {Vec3(0, 23, 0), false}}));
  double left = 0, top = 0;
  visit_sphere_pairs(o.world, o.work, [&](const contact::Contact& c) {
    if (std::min(c.a, c.b) == 0 && std::max(c.a, c.b) == 1) left = std::abs(c.force);
    if (std::min(c.a, c.b) == 1 && std::max(c.a, c.b) == 2) top = std::abs(c.force);
  });
  EXPECT_GT(left, 0);
  EXPECT_GT(top, 0);
  // The same numbers, up to the length of the normal.
  EXPECT_NEAR(o.cell[0].contact_force, left, 1e-12 * left);
  EXPECT_NEAR(o.cell[1].contact_force, left + top, 1e-12 * (left + top));
  EXPECT_NEAR(o.cell[2].contact_force, top, 1e-12 * top);
  EXPECT_EQ(o.cell[1].contacts, 2);
}

TEST(ContactForce, IsTheSameOnBothModelsAndWhatTheSphereFeels) {
  const Measured o(make_test_world({{Vec3::Zero(), true}, {Vec3(22.5, 2, 1), false}}));
  ASSERT_EQ(o.cell.size(), 2U);
  const Address sphere = cbm::cell_address(cbm_first_row(o.world.state), 0);
  const double felt = load_point(o.work.system.force.data(), sphere).norm();
  EXPECT_GT(felt, 0);
  EXPECT_EQ(o.cell[0].contact_force, o.cell[1].contact_force);
  // The solver keeps weights of links in single precision.
  EXPECT_NEAR(o.cell[1].contact_force, felt, 1e-6 * felt);
}

TEST(ContactForce, OfTwoDeformableCellsIsTheSame) {
  const Measured o(make_test_world({{Vec3::Zero(), true}, {Vec3(23, 1, 0), true}}));
  EXPECT_GT(o.cell[0].contact_force, 0);
  EXPECT_EQ(o.cell[0].contact_force, o.cell[1].contact_force);
  EXPECT_EQ(o.cell[0].contacts, 1);
}

World between_plates(const std::vector<TestCell>& cells, double distance) {
  World world = make_test_world(cells);
  for (const double side : {-1.0, 1.0}) {
    contact::Plane plane;
    plane.point = Vec3(0, 0, 0.5 * side * distance);
    plane.normal = Vec3(0, 0, -side);
    plane.material.mirror = true;
    world.params.boundary.planes.push_back(plane);
  }
  return world;
}

// What both plates press with, though their forces cancel.
TEST(ContactForce, OfACellBetweenPlatesIsThatOfBoth) {
  for (const bool deformable : {false, true}) {
    const Measured both(between_plates({{Vec3::Zero(), deformable}}, 22));
    World half = both.world;
    half.params.boundary.planes.pop_back();
    const Measured one(half);
    const CellMeasure &b = both.cell[0], &o = one.cell[0];
    EXPECT_GT(o.contact_force, 0) << deformable;
    EXPECT_EQ(b.contacts, 0);
    // The force also depends on how compressed a sphere is, which is a little more between two.
    EXPECT_GE(b.contact_force, 2 * o.contact_force * (1 - 1e-6)) << deformable;
    EXPECT_LT(b.contact_force, 2.5 * o.contact_force) << deformable;
    // Along the normals of the plates it is all of it.
    EXPECT_NEAR(b.normal_force, b.contact_force, 1e-6 * b.contact_force) << deformable;
    EXPECT_GT(b.pressure, 0);
  }
}

TEST(ContactForce, CountsEveryWallAsAPartner) {
  // In a corner of two walls: the sum of both, not their resultant.
  World world = make_test_world({{Vec3(11.5, 11.5, 0), false}});
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    contact::Plane plane;
    plane.normal = normal;
    plane.material.mirror = true;
    world.params.boundary.planes.push_back(plane);
  }
  const Measured both(world);
  world.params.boundary.planes.pop_back();
  const Measured one(world);
  EXPECT_GT(one.cell[0].contact_force, 0);
  EXPECT_GE(both.cell[0].contact_force, 2 * one.cell[0].contact_force * (1 - 1e-12));
  EXPECT_LT(both.cell[0].contact_force, 2.5 * one.cell[0].contact_force);
}

TEST(ContactForce, OfAPairIsTheForceAlongTheLineOfCentres) {
  const Measured o(make_test_world({{Vec3(-11, 0, 0), false}, {Vec3(11, 0, 0), false}}));
  EXPECT_GT(o.cell[0].normal_force, 0);
  EXPECT_NEAR(o.cell[0].normal_force, o.cell[0].contact_force, 1e-12 * o.cell[0].contact_force);
  EXPECT_EQ(o.cell[0].normal_force, o.cell[1].normal_force);
}

// A cell that is pressed flat has another surface than at rest.
TEST(ContactArea, IsAPartOfThePresentSurface) {
  World world = between_plates({{Vec3::Zero(), true}}, 23);
  dcm::State& s = world.state.dcm;
  for (const double scale : {0.8, 1.0}) {
    World scaled = world;
    for (int i = 0; i < scaled.state.dcm.group[0].topology->n_node; ++i) {
      const Address a = dcm::node_address(s, 0, i);
      store_point(scaled.state.dcm.position.data(), a, scale * load_point(s.position.data(), a));
    }
    // Everything within reach of the plates.
    scaled.params.dcm_contact.friction_range = 100;
    const Measured o(scaled);
    EXPECT_GT(o.cell[0].contact_area, 0.5 * o.cell[0].area);
    EXPECT_LE(o.cell[0].contact_area, o.cell[0].area);
  }
}

}  // namespace
}  // namespace acinus::coupling
