/// Loads of the suction of a pipette on a cell.

#include "coupling/apparatus/suction/suction_load.hpp"

#include <gtest/gtest.h>

#include "tests/dcm/cells.hpp"

namespace acinus::coupling {
namespace {

using namespace dcm;

/// Sum over the nodes, and of the sizes.
std::pair<Vec3, double> total(const Cells& c, std::size_t lane) {
  Vec3 sum = Vec3::Zero();
  double size = 0;
  for (int i = 0; i < c.n_node(); ++i) {
    sum += load_of(c, lane, i);
    size += load_of(c, lane, i).norm();
  }
  return {sum, size};
}

constexpr double kFar = 1e3;  // um, where all of every cell is in the pipette

TEST(PositivePart, ByHand) {
  constexpr double kThird = 1.0 / 3;
  const auto expect = [](const std::array<double, 3>& height, const std::array<double, 3>& part) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(positive_part(height)[k], part[k], 1e-15);
  };
  expect({1, 2, 3}, {kThird, kThird, kThird});
  expect({-1, 0, -3}, {0, 0, 0});
  // Halfway down both sides: a quarter of the area, with its centre a third of half a side off.
  expect({1, -1, -1}, {1.0 / 6, 1.0 / 24, 1.0 / 24});
  expect({-1, 1, 1}, {1.0 / 6, 7.0 / 24, 7.0 / 24});
  // A corner in the plane: half of the triangle.
  expect({0, 1, -1}, {1.0 / 6, 1.0 / 4, 1.0 / 12});
}

TEST(SuctionLoad, OfACellThatIsInsideIsAPressure) {
  Cells c = make_deformed_cells();
  add_suction_load(c.view(), {Vec3(0, 0, -kFar), Vec3::UnitZ(), kFar, 1e-3}, c.system);
  const double step = 1e-4;
  for (const int i : {0, 7, 100})
    for (int axis = 0; axis < 3; ++axis) {
      Cells d = c;
      const auto volume = [&](double by) {
        d.move(2, i, c.node(2, i) + by * Vec3::Unit(axis));
        return compute_volumes(d.view())[2];
      };
      const double slope = (volume(step) - volume(-step)) / (2 * step);
      EXPECT_NEAR(load_of(c, 2, i)[axis], 1e-3 * slope, 1e-9);
    }
  for (std::size_t l = 0; l < kLanes; ++l) {
    const auto [sum, size] = total(c, l);
    EXPECT_LE(sum.norm(), 1e-13 * size);
    EXPECT_EQ(size > 0, l != kNoCell);
  }
}

// The surface behind the mouth and the section there close a body, so that the net force is the
// pressure on the section. Twenty planes through an icosphere: the section is a polygon between the
// circles inside and around it.
TEST(SuctionLoad, NetForceIsThePressureOnTheMouth) {
  const Vec3 axis = Vec3(1, 2, -2) / 3;
  for (int k = 0; k < 20; ++k) {
    Cells c = make_rest_cells(geometry::shared_icosphere(642), {12});
    const double depth = -11 + 22.0 * k / 19;
    add_suction_load(c.view(), {depth * axis, axis, kFar, 1e-3}, c.system);
    const Vec3 net = total(c, 0).first;
    const double circle = 1e-3 * kPi * (144 - depth * depth);
    EXPECT_LT((net - net.dot(axis) * axis).norm(), 1e-13);
    // Facets stand within 1 % of the radius of the sphere: 1 % of 2 pi R^2.
    EXPECT_NEAR(net.dot(axis), circle, 1e-3 * 0.01 * 2 * kPi * 144);
  }
}

TEST(SuctionLoad, LeavesOutWhatIsBeforeTheMouthOrBesideIt) {
  Cells c = make_rest_cells(geometry::shared_icosphere(162), {12});
  add_suction_load(c.view(), {Vec3(0, 0, 13), Vec3::UnitZ(), kFar, 1}, c.system);
  add_suction_load(c.view(), {Vec3(30, 0, -13), Vec3::UnitZ(), 15, 1}, c.system);
  EXPECT_EQ(total(c, 0).second, 0);
}

// A node that goes through the mouth changes the load by as little as it moves.
TEST(SuctionLoad, HasNoJumps) {
  Vec3 before = Vec3::Zero();
  for (int k = 0; k <= 2000; ++k) {
    Cells c = make_rest_cells(geometry::shared_icosphere(42), {12});
    const double depth = 6 + 2e-3 * k;
    add_suction_load(c.view(), {Vec3(0, 0, depth), Vec3::UnitZ(), kFar, 1}, c.system);
    const Vec3 of_first = load_of(c, 0, 0);
    // Less than the circumference times the depth by which the mouth moved.
    if (k > 0) {
      EXPECT_LT((of_first - before).norm(), 2 * kPi * 12 * 2e-3);
    }
    before = of_first;
  }
}

TEST(SuctionLoad, TurnsWithCellAndPipette) {
  Cells c = make_deformed_cells(), d = c;
  auto random = reference::stream(8);
  const Mat3 turn = reference::random_rotation(random);
  const Vec3 shift(3, -400, 20), mouth(1, 2, 3);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) d.move(l, i, turn * c.node(l, i) + shift);
  add_suction_load(c.view(), {mouth, Vec3::UnitX(), kFar, 1}, c.system);
  add_suction_load(d.view(), {turn * mouth + shift, turn * Vec3::UnitX(), kFar, 1}, d.system);
  double worst = 0, scale = 0;
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) {
      scale = std::max(scale, load_of(c, l, i).norm());
      worst = std::max(worst, (turn * load_of(c, l, i) - load_of(d, l, i)).norm());
    }
  EXPECT_GT(scale, 0);
  EXPECT_LT(worst, 1e-11 * scale);  // coordinates near 400 um: some 1e3 kEps, a margin of ten
}

}  // namespace
}  // namespace acinus::coupling
