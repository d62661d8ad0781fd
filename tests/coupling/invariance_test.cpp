/// Invariance of a scene that is turned or shifted as a whole: no direction and no place of space
/// enters but through the meshes, which turn and shift with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/measure/measure.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Both models, pressed together by two plates and pulled aside.
World make_pressed_clump(double solver_tolerance) {
  std::vector<TestCell> cells = checkered_cube(22.5);
  cells[3].pull = Vec3(0.2, 0.1, 0);
  World w = make_test_world(cells);
  w.params.numerics.cg.tolerance = solver_tolerance;
  for (const double side : {-1.0, 1.0}) {
    contact::Plane plane;
    plane.point = Vec3(0, 0, 11.25 + 21.5 * side);
    plane.normal = Vec3(0, 0, -side);
    plane.material = {};
    w.params.boundary.planes.push_back(plane);
  }
  return w;
}

template <class Positions>
void move_points(Positions& position, const Mat3& turn, const Vec3& shift, bool is_place) {
  for (std::size_t row = 0; row * kPointStride < position.size(); ++row)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Address a = make_address(row, static_cast<int>(l));
      const Vec3 x = load_point(position.data(), a);
      store_point(position.data(), a, turn * x + (is_place ? shift : Vec3(Vec3::Zero())));
    }
}

World moved(World w, const Mat3& turn, const Vec3& shift) {
  move_points(w.state.dcm.position, turn, shift, true);
  move_points(w.state.cbm.position, turn, shift, true);
  for (Vec3& pull : w.state.dcm.pull) pull = turn * pull;
  w.state.cbm.pull.replace([&](const Vec3& pull) { return turn * pull; });
  for (contact::Plane& plane : w.params.boundary.planes) {
    plane.point = turn * plane.point + shift;
    plane.normal = turn * plane.normal;
  }
  return w;
}

std::vector<CellMeasure> run(World world) {
  SizedWorkspace work(world);
  EXPECT_TRUE(run_until(world, work, 1200));
  observe(world, work);
  return measure_cells(world, work);
}

struct Difference {
  double pressure = 0;  ///< largest over the cells, relative to the largest pressure
  double place = 0;     ///< um
};

Difference compare(double solver_tolerance, const Mat3& turn, const Vec3& shift) {
  const World world = make_pressed_clump(solver_tolerance);
  const std::vector<CellMeasure> here = run(world), there = run(moved(world, turn, shift));
  double largest = 0;
  for (const CellMeasure& m : here) largest = std::max(largest, std::abs(m.pressure));
  EXPECT_GT(largest, 1e-4);
  Difference d;
  for (std::size_t k = 0; k < here.size(); ++k) {
    d.pressure = std::max(d.pressure, std::abs(here[k].pressure - there[k].pressure) / largest);
    d.place = std::max(d.place, (turn * here[k].center + shift - there[k].center).norm());
  }
  return d;
}

Mat3 about(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(Invariance, UnderRotation) {
  for (const Mat3& turn : {about(Vec3::UnitZ(), 0.5 * kPi), about(Vec3(1, 2, 3), 1.1)}) {
    const Difference tight = compare(1e-8, turn, Vec3::Zero());
    std::printf("turned, tight: pressure %.2g, place %.2g um\n", tight.pressure, tight.place);
    EXPECT_LT(tight.pressure, 1e-5);
    EXPECT_LT(tight.place, 1e-5);
    const Difference usual = compare(3e-3, turn, Vec3::Zero());
    std::printf("turned, usual: pressure %.2g, place %.2g um\n", usual.pressure, usual.place);
    EXPECT_LT(usual.pressure, 5e-3);
    EXPECT_LT(usual.place, 5e-3);
  }
}

TEST(Invariance, UnderShift) {
  const Vec3 millimetre(1000, -700, 300);
  const Difference tight = compare(1e-8, Mat3::Identity(), millimetre);
  std::printf("shifted, tight: pressure %.2g, place %.2g um\n", tight.pressure, tight.place);
  EXPECT_LT(tight.pressure, 1e-5);
  EXPECT_LT(tight.place, 1e-5);
  const Difference usual = compare(3e-3, Mat3::Identity(), millimetre);
  std::printf("shifted, usual: pressure %.2g, place %.2g um\n", usual.pressure, usual.place);
  EXPECT_LT(usual.pressure, 5e-3);
}

}  // namespace
}  // namespace acinus::coupling
