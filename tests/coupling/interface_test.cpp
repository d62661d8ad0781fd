/// Forces across the interface: equal and opposite, and the same from one solve or two.

#include "coupling/interface/interface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <vector>

#include "core/parallel/threads.hpp"
#include "coupling/measure/pair_contacts.hpp"
#include "coupling/step/move_points.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "dcm/contact/contact_params.hpp"
#include "tests/coupling/partitioned.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Force on every unknown, with and without the interface contacts.
std::vector<double> forces(const World& world, Workspace& work, bool interface) {
  assemble(world, 1.0, work, {interface});
  return {work.system.force.begin(), work.system.force.end()};
}

TEST(Interface, ForcesOnBothModelsSumToZero) {
  // A sphere against a face, an edge and a corner of a deformable cell, and a whole cube of both.
  std::vector<std::vector<TestCell>> scenes{checkered_cube(23.7)};
  for (const Vec3& direction :
       {Vec3(1, 0, 0), Vec3(0, 0.85065, 0.52573), Vec3(0.35682, 0, 0.93417), Vec3(1, 1, 1)})
    scenes.push_back({{Vec3::Zero()}, {23.5 * direction.normalized(), false}});
  for (const auto& scene : scenes) {
    const World world = make_test_world(scene);
    SizedWorkspace work(world);
    const std::vector<double> with = forces(world, work, true),
                              without = forces(world, work, false);
    Vec3 dcm_sum = Vec3::Zero(), cbm_sum = Vec3::Zero();
    double size = 0;
    const std::size_t split = cbm_first_row(world.state) * kPointStride;
    for (std::size_t row = 0; row < work.system.n_row; ++row)
      for (int l = 0; l < kLanes; ++l) {
        const Address a = make_address(row, l);
        const Vec3 f = load_point(with.data(), a) - load_point(without.data(), a);
        (a < split ? dcm_sum : cbm_sum) += f;
        size += f.norm();
      }
    EXPECT_GT(size, 1e-3);
    std::printf("interface force of the DCM side %.3g nN, sum of both sides / size %.2g\n",
                dcm_sum.norm(), (dcm_sum + cbm_sum).norm() / size);
    EXPECT_LT((dcm_sum + cbm_sum).norm(), 1e-12 * size);
  }
}

TEST(Interface, ForceListAddsUpToTheForces) {
  const World world = make_test_world(checkered_cube(23.7));
  SizedWorkspace work(world);
  const std::vector<double> with = forces(world, work, true);
  Vec3 listed = Vec3::Zero();
  double size = 0;
  for (const InterfaceForce& f : interface_forces(world, work)) {
    listed += f.force;
    size += f.force.norm();
    EXPECT_GT(f.area, 0);
  }
  const std::vector<double> without = forces(world, work, false);
  Vec3 summed = Vec3::Zero();
  for (std::size_t row = 0; row < cbm_first_row(world.state); ++row)
    for (int l = 0; l < kLanes; ++l)
      summed += load_point(with.data(), make_address(row, l)) -
                load_point(without.data(), make_address(row, l));
  EXPECT_LT((listed - summed).norm(), 1e-11 * size);
}

/// Linearly implicit step in which each model is solved alone.
void step_partitioned(World& world, double step, Workspace& work) {
  assemble(world, step, work);
  for (std::size_t k = 0; k < work.rhs.size(); ++k)
    work.rhs[k] = work.system.force[k] + work.system.external_force[k];
  const solve::CgResult result =
      solve_partitioned(work.op, work.rhs, work.move, world.state.dcm.group.size(),
                        world.params.numerics.cg, work.cg);
  ASSERT_TRUE(result.status.ok) << result.status.cause;
  move_points(world.state, work.move);
  std::swap(world.state.cbm.touching, work.cbm.touching);
  world.state.clock.time += step;
}

TEST(Interface, PartitionedTwinAgreesWithTheSingleSolve) {
  // A square of two cells of each model with coarse meshes: the exchange is slow, the physics the
  // same.
  std::vector<TestCell> cells = checkered_cube(24.0);
  cells.resize(4);
  cells[0].pull = Vec3(0.2, 0.1, 0);
  World single = make_test_world(cells, 60, 42);
  single.params.numerics.cg = {1e-10, 20000};
  World twin = single;
  Workspace single_work, twin_work;
  size_workspace(single, single_work);
  size_workspace(twin, twin_work);
  ASSERT_TRUE(run_until(single, single_work, 3600));
  for (int k = 0; k < 60; ++k) step_partitioned(twin, 60, twin_work);
  const std::vector<double> a = gather_positions(single.state), b = gather_positions(twin.state);
  double largest = 0, moved = 0;
  const std::vector<double> start = gather_positions(make_test_world(cells, 60, 42).state);
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]));
    moved = std::max(moved, std::abs(a[k] - start[k]));
  }
  std::printf("single against partitioned after 1 h: %.3g um apart, moved %.3g um\n", largest,
              moved);
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(largest, 1e-3);
}

TEST(Interface, CompliantStiffnessIsTheSeriesOfPenaltyAndWinkler) {
  // k_w = 4 E* / (3 pi R sqrt(indentation / R)); E* = 0.45/(1 - 0.47^2), R = 12, indentation = 0.48
  const double young = 0.45 / (1 - 0.47 * 0.47), winkler = 4 * young / (3 * kPi * 12 * 0.2);
  const SphereSurface plain{12, 0.45, 0.47, {0.45, 0}, nullptr};
  EXPECT_NEAR(compute_compliance(5, plain, 0.48).stiffness, 5 * winkler / (5 + winkler), 1e-15);
  EXPECT_EQ(compute_compliance(5, plain, 0.48).slope, 0);
  EXPECT_EQ(compute_compliance(5, plain, 0).stiffness,
            compute_compliance(5, plain, 12 * kLeastDepth).stiffness);
  EXPECT_EQ(compute_compliance(5, plain, 12 * kMostDepth).stiffness,
            compute_compliance(5, plain, 12 * 0.3).stiffness);
}

TEST(Interface, ACalibratedSphereHardensUnderAnIndentationDeeperThanItsOverlap) {
  const cbm::StiffnessLaw law{{{4000, 4}}, {}, 0.2};
  const double mean = 0.12;
  const SphereSurface sphere{12, 0.45, 0.47, cbm::corrected_modulus(law, 0.45, mean), &law};
  SphereSurface frozen = sphere;
  frozen.law = nullptr;
  // As deep as the mean or less: the modulus of the mean overlap, which does not depend on the
  // indentation.
  for (const double d : {0.05, 0.12}) {
    EXPECT_EQ(compute_compliance(5, sphere, 12 * d).stiffness,
              compute_compliance(5, frozen, 12 * d).stiffness);
    EXPECT_EQ(compute_compliance(5, sphere, 12 * 0.999 * d).slope, 0);
  }
  // Deeper: stiffer, without a jump, and by what the slope says where the contact does not widen.
  double before = compute_compliance(5, sphere, 12 * mean).stiffness;
  for (double d = mean; d < 0.35; d += 1e-3) {
    const double now = compute_compliance(5, sphere, 12 * d).stiffness;
    EXPECT_LT(std::abs(now - before), 0.04 * before);
    before = now;
    if (d < kMostDepth + 1e-4) continue;
    EXPECT_GT(now, 1.5 * compute_compliance(5, frozen, 12 * d).stiffness);
    const double step = 1e-4, above = compute_compliance(5, sphere, 12 * d + step).stiffness,
                 below = compute_compliance(5, sphere, 12 * d - step).stiffness;
    if (std::abs(d - 0.2) > 1e-3 && std::abs(d - 0.3) > 1e-3) {
      EXPECT_NEAR(compute_compliance(5, sphere, 12 * d).slope, (above - below) / (2 * step), 1e-6);
    }
  }
}

/// Deformable cell that indents a sphere by so much, um, without adhesion.
World indented_sphere(double depth) {
  World w = make_test_world({{Vec3::Zero()}, {Vec3(1, 2, 3).normalized() * 24, false}});
  w.params.dcm[0].adhesion = w.params.cbm[0].adhesion = 0;
  SizedWorkspace work(w);
  assemble(w, 1.0, work);
  double gap = 1;
  for (const contact::Contact& k : work.contacts.interface()) gap = std::min(gap, k.gap);
  // The normal is that of the line of centres to first order, so two rounds come near enough.
  Vec3 x = cbm::center_of(w.state.cbm, 0);
  store_point(w.state.cbm.position.data(), cbm::cell_address(0, 0), x * (1 - (gap + depth) / 24));
  return w;
}

// However far a surface is stretched, a sphere pushes at it with the pressure of its bed times the
// area there is: with that at rest, tongues of deformable cells flow into spheres.
TEST(Interface, PressesOnThePresentAreaOfAStretchedSurface) {
  const World rested = indented_sphere(1);
  World stretched = rested;  // the same nodes, of a cell that is smaller at rest
  for (auto& v : stretched.state.dcm.volume) v.from = v.to = 0.6 * v.to;
  Workspace a, b;
  size_workspace(rested, a);
  size_workspace(stretched, b);
  forces(rested, a, true);
  forces(stretched, b, true);
  const auto pressing = [](const Workspace& w) {
    contact::Contacts found;
    std::ranges::copy_if(w.contacts.interface(), std::back_inserter(found),
                         [](const contact::Contact& k) { return k.gap < 0; });
    return found;
  };
  const contact::Contacts x = pressing(a), y = pressing(b);
  ASSERT_EQ(x.size(), y.size());
  ASSERT_GT(x.size(), 5u);
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_NEAR(x[k].force, y[k].force, 1e-13 * x[k].force);  // area at rest times its inverse
    EXPECT_NEAR(x[k].slope, y[k].slope, 1e-13 * x[k].slope);
  }
}

// Indented by less than the least depth a bed has one stiffness, and an energy of 1/2 k g^2 on the
// present area, which a sphere that moves does not change.
TEST(Interface, ForceOnTheSphereIsMinusTheGradientOfTheBedsEnergy) {
  World w = indented_sphere(0.8 * kLeastDepth * 12);
  SizedWorkspace work(w);
  const Address at = cbm::cell_address(0, 0);
  const Vec3 center = cbm::center_of(w.state.cbm, 0);
  const auto energy = [&](const Vec3& x) {
    store_point(w.state.cbm.position.data(), at, x);
    forces(w, work, true);
    double sum = 0;
    for (const contact::Contact& k : work.contacts.interface())
      if (k.gap < 0) sum += 0.5 * k.slope * k.gap * k.gap;
    return sum;
  };
  energy(center);
  Vec3 force = Vec3::Zero();
  for (const contact::Contact& k : work.contacts.interface()) force -= k.force * k.normal;
  EXPECT_GT(force.norm(), 0.02);
  const double step = 1e-4;
  for (int m = 0; m < 3; ++m) {
    const Vec3 shift = step * Vec3::Unit(m);
    const double slope = (energy(center + shift) - energy(center - shift)) / (2 * step);
    // k g^2 is quadratic but for points that begin to touch: of depth step, 1/2 k A step^2 each.
    EXPECT_NEAR(force[m], -slope, 1e-3 * force.norm());
  }
}

TEST(Step, SameBitsForOneAndTwoThreads) {
  std::uint64_t hash[2];
  for (int threads : {1, 2}) {
    set_threads(threads);
    World world = make_test_world(checkered_cube());
    world.params.motility.random = true;
    world.params.numerics.adaptive = true;
    SizedWorkspace work(world);
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(take_step(world, work, 1e9).accepted);
    hash[threads - 1] = hash_state(world.state);
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(Step, PairForcesBalance) {
  World world = make_test_world(checkered_cube());
  SizedWorkspace work(world);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(take_step(world, work, 1e9).accepted);
  std::printf("momentum %.3g, torque %.3g\n", world.state.balance.momentum,
              world.state.balance.torque);
  EXPECT_LT(world.state.balance.momentum, 1e-9);
  EXPECT_LT(world.state.balance.torque, 1e-9);
}

// Friction from node to node pulls two cells apart from where they touch, but as hard on one as on
// the other. What turns whole aggregates need not balance.
TEST(NodeFriction, BalancesMomentum) {
  std::vector<TestCell> cells = checkered_cube(23.5);
  for (std::size_t k = 0; k < 6; ++k) cells[k].deformable = true;  // so that some meet each other
  World world = make_test_world(cells);
  world.params.dcm_contact.friction_form = dcm::FrictionForm::kNodes;
  SizedWorkspace work(world);
  ASSERT_TRUE(run_until(world, work, 1200));
  EXPECT_GT(work.system.point_links.size(), 500u);
  std::printf("momentum %.3g, torque %.3g, friction torque %.3g\n", world.state.balance.momentum,
              world.state.balance.torque, world.state.balance.friction_torque);
  EXPECT_LT(world.state.balance.momentum, 1e-9);
  EXPECT_LT(world.state.balance.torque, 1e-9);
}

}  // namespace
}  // namespace acinus::coupling
