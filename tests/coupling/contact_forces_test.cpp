/// Contacts one by one: reactions of the boundary, who touches whom, the interface's balance.

#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/contact_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "contact/hertz.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/measure/measure.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_points.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

using contact::Partner;
using Pairs = std::vector<CellPair>;

contact::Plane mirror_at(const Vec3& point, const Vec3& normal) {
  contact::Plane plane;
  plane.point = point;
  plane.normal = normal;
  plane.material.mirror = true;
  return plane;
}

TEST(Reactions, OfWallsOnASphereAreThoseOfItsLaw) {
  World world = make_test_world({{Vec3::Zero(), false}});
  world.params.boundary.planes = {mirror_at(Vec3(-11, 0, 0), Vec3::UnitX()),
                                  mirror_at(Vec3(11.5, 0, 0), -Vec3::UnitX()),
                                  mirror_at(Vec3(0, 0, -20), Vec3::UnitZ())};
  const Observed o(world);
  const Reactions r = compute_reactions(o.world, o.work);
  const double young = cbm::young_from_bulk(2.5, 0.47);
  const contact::SphereBody sphere{12, young, o.world.params.cbm[0].poisson};
  const double deep = contact::mirror_wall_force(sphere, 11).force,
               shallow = contact::mirror_wall_force(sphere, 11.5).force;
  ASSERT_EQ(r.of(Partner::kPlane).size(), 3U);
  // Round-off of the sphere's radius, which comes from its volume.
  EXPECT_NEAR(r.of(Partner::kPlane)[0].normal, deep, 1e-12 * deep);
  EXPECT_NEAR(r.of(Partner::kPlane)[1].normal, shallow, 1e-12 * deep);
  EXPECT_NEAR(r.of(Partner::kPlane)[0].net.x(), -deep, 1e-12 * deep)
      << "the wall is pushed outward";
  EXPECT_NEAR(r.of(Partner::kPlane)[1].net.x(), shallow, 1e-12 * deep);
  EXPECT_EQ(r.of(Partner::kPlane)[2].normal, 0);
  EXPECT_EQ(r.of(Partner::kPlane)[2].net, Vec3(Vec3::Zero()));
}

TEST(Reactions, OfAWallOnADeformableCellIsTheSumOverItsPoints) {
  World world = make_test_world({{Vec3::Zero(), true}});
  world.params.boundary.planes = {mirror_at(Vec3(0, 0, -11.6), Vec3::UnitZ())};
  const Observed o(world);
  const Reaction wall = compute_reactions(o.world, o.work).of(Partner::kPlane)[0];
  const contact::SurfaceBody& body = o.work.dcm.body[0];
  const dcm::ContactParams& c = o.world.params.dcm_contact;
  double expected = 0;
  for (std::size_t p = 0; p < contact::n_points(body, c.quadrature); ++p) {
    const int point = static_cast<int>(p);
    const double gap =
        contact::point_position(body, contact::point_stencil(body, c.quadrature, point)).z() + 11.6;
    if (gap < 0)
      expected -= c.repulsion * gap * dcm::point_area(*body.topology, c.quadrature, point, 12);
  }
  EXPECT_GT(expected, 1);
  // The area in the links is a double; sums of a few dozen points.
  EXPECT_NEAR(wall.normal, expected, 1e-12 * expected);
  EXPECT_NEAR(wall.net.z(), -expected, 1e-12 * expected);
  EXPECT_GT(wall.area, 0);
}

/// Eight cells of both models in a box that is too small for them.
World compressed_box() {
  World world = make_test_world(checkered_cube(22.5), 60, 42);
  for (int k = 0; k < 3; ++k) {
    world.params.boundary.planes.push_back(mirror_at(-11 * Vec3::Unit(k), Vec3::Unit(k)));
    world.params.boundary.planes.push_back(mirror_at(33.5 * Vec3::Unit(k), -Vec3::Unit(k)));
  }
  return world;
}

TEST(Reactions, OfOppositeWallsAgreeWhenTheCellsAreAtRest) {
  World world = compressed_box();
  SizedWorkspace work(world);
  ASSERT_TRUE(run_until(world, work, 2 * 3600));
  const std::vector<double> before = gather_positions(world.state);
  ASSERT_TRUE(run_until(world, work, 2 * 3600 + 60));
  double speed = 0;
  const std::vector<double> after = gather_positions(world.state);
  for (std::size_t k = 0; k < after.size(); ++k)
    speed = std::max(speed, std::abs(after[k] - before[k]) / 60);
  observe(world, work);
  const Reactions r = compute_reactions(world, work);
  // What is left between opposite walls moves the cells against the medium: no more than the
  // surfaces of four cells of each model with Table 1's friction, at the largest speed there is.
  const double medium = 4 * 4 * kPi * 144 * (0.1 + 0.5);
  for (std::size_t k = 0; k < 6; k += 2) {
    const Vec3 net = r.of(Partner::kPlane)[k].net + r.of(Partner::kPlane)[k + 1].net;
    std::printf("axis %zu: %.6f and %.6f nN, differ by %.2g, drag at most %.2g\n", k / 2,
                r.of(Partner::kPlane)[k].normal, r.of(Partner::kPlane)[k + 1].normal,
                std::abs(net[static_cast<int>(k / 2)]), medium * speed);
    EXPECT_GT(r.of(Partner::kPlane)[k].normal, 1);
    EXPECT_LE(net.norm(), medium * speed);
    EXPECT_LE(net.norm(), 0.01 * r.of(Partner::kPlane)[k].normal);
  }
}

TEST(Reactions, OfVesselsAreThoseOfEverySegment) {
  World world = make_test_world({{Vec3(0, 15.7, 0), false}, {Vec3(40, -16.2, 0), true}});
  geometry::Network n;
  n.node = {Vec3(-20, 0, 0), Vec3(20, 0, 0), Vec3(60, 0, 0)};
  n.segment = {{0, 1}, {1, 2}};
  n.radius = {{4.7, 4.7}, {4.7, 4.7}};
  contact::set_network(world.params.boundary.vessels, n);
  world.params.boundary.vessels.material = {0, 0.6, 0.4, false};
  const Observed o(world);
  const Reactions r = compute_reactions(o.world, o.work);
  ASSERT_EQ(r.of(Partner::kVessel).size(), 2U);
  EXPECT_LT(r.of(Partner::kVessel)[0].net.y(), 0) << "the sphere presses down";
  EXPECT_GT(r.of(Partner::kVessel)[1].net.y(), 0) << "the deformable cell presses up";
  EXPECT_NEAR(r.of(Partner::kVessel)[0].normal, -r.of(Partner::kVessel)[0].net.y(),
              1e-12 * r.of(Partner::kVessel)[0].normal);
  EXPECT_GT(r.of(Partner::kVessel)[1].area, 0);
}

TEST(Touching, PairsAndClustersOfCells) {
  // Three in a row, of both models; a pair; one alone.
  const Observed o(make_test_world({{Vec3(0, 0, 0), true},
                                    {Vec3(23.5, 0, 0), false},
                                    {Vec3(47, 0, 0), true},
                                    {Vec3(0, 100, 0), false},
                                    {Vec3(0, 123, 0), false},
                                    {Vec3(0, 0, 100), false}}));
  // Deformable cells come first: 0 and 1 are the ends of the row.
  const Pairs touching = find_touching(o.world, o.work);
  EXPECT_EQ(touching, (Pairs{{0, 2}, {1, 2}, {3, 4}}));
  EXPECT_EQ(cluster_sizes(6, touching), (std::vector<int>{3, 3, 3, 2, 2, 1}));
}

TEST(Interface, ExertsNoNetForceOnBothModelsTogether) {
  const Observed o(make_test_world(checkered_cube(22.5)));
  ASSERT_FALSE(o.work.contacts.interface().empty());
  EXPECT_LT(interface_residual(o.world, o.work), 1e-14);
}

TEST(Reactions, DoNotDependOnTheNumberOfThreads) {
  const World world = compressed_box();
  const int before = thread_count();
  std::vector<Reaction> of[2];
  for (const int threads : {1, 3}) {
    set_threads(threads);
    const Observed o(world);
    of[threads / 2] = compute_reactions(o.world, o.work).of(Partner::kPlane);
  }
  set_threads(before);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(of[0][k].net, of[1][k].net);
    EXPECT_EQ(of[0][k].normal, of[1][k].normal);
  }
}

}  // namespace
}  // namespace acinus::coupling
