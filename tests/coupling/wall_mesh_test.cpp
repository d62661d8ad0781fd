/// Cells at the surface of vessels, and at the cones that it is laid around.

#include "contact/wall_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "geometry/implicit/vessel_mesh.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kForkRadius = 5;

/// Three vessels that meet in the origin.
geometry::Network fork() {
  geometry::Network n;
  n.node = {Vec3::Zero(), Vec3(-40, 0, 0), Vec3(30, 28, 0), Vec3(30, -28, 5)};
  n.segment = {{0, 1}, {0, 2}, {0, 3}};
  n.radius = {{kForkRadius, 6}, {kForkRadius, 4}, {kForkRadius, 4}};
  return n;
}

contact::Vessels vessels_of(const geometry::Network& network, bool mesh) {
  contact::Vessels v;
  contact::set_network(v, network);
  v.material = {0.005, 0.6, 0.4, false};
  geometry::VesselMeshOptions o;
  o.fineness = 0.15;  // as a run has it
  if (mesh)
    v.wall = std::make_shared<const contact::WallMesh>(
        contact::make_wall_mesh(network, geometry::make_vessel_mesh(network, o).surface));
  return v;
}

TEST(WallMesh, LiesWhereTheConesAre) {
  const contact::Vessels v = vessels_of(fork(), true);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-45, 45);
  double worst = 0;
  int seen = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 x(number(random), number(random), 0.4 * number(random));
    for (int s = 0; s < 3; ++s) {
      const contact::Gap cone = contact::gap_to_segment(v.network, s, x);
      // Beside the joint, where creases are rounded, and away from ends.
      if (std::abs(cone.gap) > 2 || cone.parameter < 0.35 || cone.parameter > 0.95) continue;
      const contact::Gap wall = contact::gap_to_wall(v, s, x, 10);
      worst = std::max(worst, std::abs(wall.gap - cone.gap) / cone.radius);
      EXPECT_GT(wall.normal.dot(cone.normal), 0.8);  // of facets seen from nearby
      EXPECT_EQ(wall.radius, cone.radius);
      ++seen;
    }
  }
  std::printf("%d places: the wall is within %.2g of the radius\n", seen, worst);
  EXPECT_GT(seen, 300);
  EXPECT_LT(worst, 0.02);
}

/// A segment inside other vessels has no wall of its own and is replaced by a cone.
TEST(WallMesh, FallsBackOnConesWhereThereIsNoWall) {
  geometry::Network n = fork();
  n.node.push_back(Vec3(-3, 0, 0));
  n.segment.push_back({0, 4});
  n.radius.push_back({3, 3});
  const contact::Vessels v = vessels_of(n, true);
  EXPECT_EQ(v.wall->first_of_segment[4], v.wall->first_of_segment[3]);
  const Vec3 x(-1, 4, 0);
  EXPECT_EQ(contact::gap_to_wall(v, 3, x, 10).gap, contact::gap_to_segment(v.network, 3, x).gap);
}

/// Cell on the straight part of a vessel, pressed down.
Vec3 force_on_cell(bool deformable, bool mesh, double depth) {
  World w = make_test_world({{Vec3(-25, 0, 12 + 5.6 - depth), deformable}});
  w.params.boundary.vessels = vessels_of(fork(), mesh);
  SizedWorkspace work(w);
  assemble(w, 1, work);
  Vec3 sum = Vec3::Zero();
  for (std::size_t row = 0; row < work.system.n_row; ++row)
    for (int l = 0; l < kLanes; ++l)
      sum += load_point(work.system.external_force.data(), make_address(row, l));
  for (const contact::Contact& k : work.contacts.all) {
    EXPECT_EQ(k.partner, contact::Partner::kVessel);
    EXPECT_EQ(k.b, 0);
  }
  return sum;
}

TEST(WallMesh, PushesCellsAsConesDo) {
  for (const bool deformable : {true, false}) {
    const double depth = deformable ? 1.0 : 1.5;
    const Vec3 cone = force_on_cell(deformable, false, depth),
               wall = force_on_cell(deformable, true, depth);
    std::printf("%s: cones push with %.4g nN, their surface with %.4g\n",
                deformable ? "DCM" : "CBM", cone.z(), wall.z());
    EXPECT_GT(cone.z(), 0.01);
    // The surface is up to a few hundredths of the radius beside them, 0.1 um of this depth.
    EXPECT_NEAR(wall.z(), cone.z(), 0.15 * cone.z());
  }
}

}  // namespace
}  // namespace acinus::coupling
