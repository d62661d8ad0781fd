/// Loads of an optical stretcher on a cell.

#include "coupling/apparatus/stretcher/stretch_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "coupling/apparatus/stretcher/optical_stress.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::coupling {
namespace {

using namespace dcm;

using reference::kEps;

// Appendix 3: 1.05 Pa at 1.1 W is printed, (n_c - n_m) 2 P / (pi R^2 c) is what the equations give.
TEST(OpticalStress, OfThePapersBeams) {
  LaserBeams b{1.1e15};
  EXPECT_NEAR(reflectance(b), 1.24376e-4, 1e-9);
  EXPECT_NEAR(1e3 * stress_amplitude(b), 1.0415, 0.01 * 1.0415);
  EXPECT_NEAR(1e3 * stress_amplitude(b), 1.05, 0.02 * 1.05);
  std::printf("stress at 1.1 W: %.7f Pa\n", 1e3 * stress_amplitude(b));
  const double at_full = stress_amplitude(b);
  b.power *= 0.5;
  EXPECT_DOUBLE_EQ(stress_amplitude(b), 0.5 * at_full);
  b.cell = b.medium;
  EXPECT_NEAR(stress_amplitude(b), 0, 1e-18) << "nothing to bend the light";
}

const StretchLoad kLoad{Vec3(1, 2, -2) / 3, 2, 1e-3};

TEST(StretchLoad, LeavesNoNetForceOnAnyCell) {
  Cells c = make_deformed_cells();
  add_stretch_load(c.view(), kLoad, c.system);
  for (std::size_t l = 0; l < kLanes; ++l) {
    Vec3 sum = Vec3::Zero();
    double size = 0;
    for (int i = 0; i < c.n_node(); ++i) {
      sum += load_of(c, l, i);
      size += load_of(c, l, i).norm();
    }
    EXPECT_LE(sum.norm(), 1e-14 * size);
    EXPECT_EQ(size > 0, l != kNoCell);
  }
}

// With n = 0 the load is a pressure: the gradient of stress times volume, without net force by
// itself.
TEST(StretchLoad, WithoutAngleIsAPressure) {
  Cells c = make_deformed_cells();
  add_stretch_load(c.view(), {Vec3::UnitZ(), 0, 1e-3}, c.system);
  const double step = 1e-4;
  for (const int i : {0, 7, 100}) {
    for (int axis = 0; axis < 3; ++axis) {
      Cells d = c;
      const Vec3 x = c.node(2, i);
      d.move(2, i, x + step * Vec3::Unit(axis));
      const double above = compute_volumes(d.view())[2];
      d.move(2, i, x - step * Vec3::Unit(axis));
      const double below = compute_volumes(d.view())[2];
      EXPECT_NEAR(load_of(c, 2, i)[axis], 1e-3 * (above - below) / (2 * step), 1e-9);
    }
  }
}

// On a sphere the exact work of the load per shift of the two caps: sum of F . n cos^2 / area =
// stress times mean of cos^4, a fifth.
TEST(StretchLoad, OnASphereFallsWithTheCosine) {
  for (const int nodes : {162, 642, 2562}) {
    Cells c = make_rest_cells(geometry::shared_icosphere(nodes), {8.8});
    add_stretch_load(c.view(), kLoad, c.system);
    double work = 0;
    for (int i = 0; i < nodes; ++i) {
      const Vec3 n = c.node(0, i).normalized();
      work += load_of(c, 0, i).dot(n) * std::pow(n.dot(kLoad.axis), 2);
    }
    const double error = work / (1e-3 * 4 * kPi * 8.8 * 8.8 / 5) - 1;
    std::printf("%4d nodes: work of the load on a sphere off by %.2e\n", nodes, error);
    EXPECT_LT(std::abs(error), 4.0 / nodes);
  }
}

TEST(StretchLoad, TurnsWithCellAndAxis) {
  Cells c = make_deformed_cells();
  auto random = reference::stream(8);
  const Mat3 turn = reference::random_rotation(random);
  const Vec3 shift(3, -400, 20);
  Cells d = c;
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) d.move(l, i, turn * c.node(l, i) + shift);
  add_stretch_load(c.view(), kLoad, c.system);
  add_stretch_load(d.view(), {turn * kLoad.axis, kLoad.exponent, kLoad.stress}, d.system);
  double worst = 0, scale = 0;
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) {
      scale = std::max(scale, load_of(c, l, i).norm());
      worst = std::max(worst, (turn * load_of(c, l, i) - load_of(d, l, i)).norm());
    }
  EXPECT_LT(worst, 1e-11 * scale);
}

}  // namespace
}  // namespace acinus::coupling
