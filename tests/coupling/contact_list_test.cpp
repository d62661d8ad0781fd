/// List of contacts per pair: it adds up to what is measured of each cell.

#include "coupling/measure/contact_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Eight cells of both models in a box that is too small for them.
World crowded_box(dcm::ContactLaw law) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 8; ++k)
    cells.push_back({22.5 * Vec3(k % 2, k / 2 % 2, k / 4), k != 3 && k != 5});
  World world = make_test_world(cells, 60, 162);
  world.params.dcm_contact.law = law;
  for (const double side : {-1.0, 1.0}) {
    contact::Plane plane;
    plane.point = Vec3(0, 0, side < 0 ? -11.5 : 34);
    plane.normal = -side * Vec3::UnitZ();
    plane.material.mirror = true;
    world.params.boundary.planes.push_back(plane);
  }
  return world;
}

struct Sums {
  double area = 0, force = 0, normal = 0;
  int contacts = 0;
};

void expect_list_adds_up(dcm::ContactLaw law) {
  const Observed o(crowded_box(law));
  const std::vector<CellMeasure> cells = measure_cells(o.world, o.work);
  const std::vector<CellContact> list = list_contacts(o.world, o.work, cells);
  std::vector<Sums> sum(cells.size());
  int walls = 0, mixed = 0, shells = 0;
  for (const CellContact& c : list) {
    const auto add = [&](std::size_t cell, double area) {
      sum[cell].area += area;
      sum[cell].force += c.force.norm();
      sum[cell].normal += c.normal_force;
      sum[cell].contacts += c.touching ? 1 : 0;
    };
    EXPECT_GE(std::min(c.area_a, c.area_b), 0);
    add(c.a, c.area_a);
    if (c.b == kNoCell) {
      ++walls;
      EXPECT_EQ(c.partner, contact::Partner::kPlane);
      EXPECT_EQ(c.area_b, 0);
      EXPECT_EQ(c.index, cells[c.a].center.z() > 10 ? 1 : 0);
      EXPECT_GT(c.normal_force, 0);
      continue;
    }
    EXPECT_LT(c.a, c.b);
    EXPECT_EQ(c.partner == contact::Partner::kSurface, cells[c.b].deformable);
    (cells[c.a].deformable && cells[c.b].deformable ? shells : mixed) += 1;
    add(c.b, c.area_b);
  }
  EXPECT_EQ(walls, 8);
  EXPECT_GE(shells, 5);
  EXPECT_GE(mixed, 5);
  double total = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const CellMeasure& m = cells[k];
    EXPECT_NEAR(sum[k].area, m.contact_area, 1e-12 * m.area) << k;
    EXPECT_EQ(sum[k].contacts, m.contacts) << k;
    EXPECT_NEAR(sum[k].force, m.contact_force, 1e-14 * m.contact_force) << k;
    EXPECT_NEAR(sum[k].normal, m.normal_force, 1e-14 * m.contact_force) << k;
    EXPECT_GT(m.contact_area, 1) << k;
    total += m.contact_area;
  }
  std::printf("%zu contacts, %.1f um^2 in all\n", list.size(), total);
}

TEST(ContactList, OfPointsAddsUpToTheMeasuresOfCells) {
  expect_list_adds_up(dcm::ContactLaw::kCohesive);
}

TEST(ContactList, OfTrianglesAddsUpToTheMeasuresOfCells) {
  expect_list_adds_up(dcm::ContactLaw::kMaugisDugdale);
}

TEST(ContactList, OfTwoSpheresHasTheForceOnTheFirstAndTheAreaOfBoth) {
  const Observed o(make_test_world({{Vec3::Zero(), false}, {Vec3(22, 0, 0), false}}));
  const std::vector<CellMeasure> cells = measure_cells(o.world, o.work);
  const std::vector<CellContact> list = list_contacts(o.world, o.work, cells);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_LT(list[0].force.x(), 0) << "the second pushes the first to the left";
  EXPECT_EQ(list[0].normal_force, -list[0].force.x());
  EXPECT_EQ(list[0].area_a, list[0].area_b);
  EXPECT_EQ(list[0].area_a, cells[0].contact_area);
}

TEST(ContactList, LeavesOutCellsThatTouchNothing) {
  const Observed o(make_test_world({{Vec3::Zero(), true}, {Vec3(30, 0, 0), false}}));
  EXPECT_TRUE(list_contacts(o.world, o.work, measure_cells(o.world, o.work)).empty());
}

}  // namespace
}  // namespace acinus::coupling
