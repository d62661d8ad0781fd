/// Pair of cells under the law of Maugis-Dugdale, step by step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "contact/maugis_overlap.hpp"
#include "coupling/measure/adhesion.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/step/step.hpp"
#include "dcm/contact/contact_params.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kApart = 23.9;  ///< um, of the centres; their radius is 12

World make_pair(const Mat3& turn, const Vec3& shift) {
  World w = make_test_world({{Vec3(-kApart / 2, 0, 0)}, {Vec3(kApart / 2, 0, 0)}}, 2);
  w.params.dcm_contact.law = dcm::ContactLaw::kMaugisDugdale;
  w.params.dcm_contact.cell_friction = 0;
  w.params.dcm[0].medium_friction = 1e-3;
  w.params.dcm[0].friction_across = 0;  // blind to rotation
  HeldRows<double>& x = w.state.dcm.position;
  for (std::size_t row = 0; row * kPointStride < x.size(); ++row)
    for (int l = 0; l < 2; ++l) {
      const Address a = make_address(row, l);
      store_point(x.data(), a, turn * load_point(x.data(), a) + shift);
    }
  return w;
}

struct PairAtRest {
  std::vector<CellMeasure> cell;
  double area = 0;      ///< um^2
  double distance = 0;  ///< um
};

PairAtRest settle(World& world, double time) {
  SizedWorkspace work(world);
  EXPECT_TRUE(run_until(world, work, time));
  observe(world, work);
  const std::vector<CellMeasure> cell = measure_cells(world, work);
  return {cell, measure_adhesion(world, work).area, (cell[1].center - cell[0].center).norm()};
}

TEST(TriangleContactSteps, APairAdheresAndSettlesInOrdinarySteps) {
  World world = make_pair(Mat3::Identity(), Vec3::Zero());
  const PairAtRest soon = settle(world, 1000), late = settle(world, 1400);
  std::printf(
      "pair: area %.1f then %.1f um^2, distance %.3f then %.3f um, pressure %.2f Pa; %lld "
      "steps, %lld rejected; momentum %.1e, torque %.1e\n",
      soon.area, late.area, soon.distance, late.distance, 1e3 * late.cell[0].cytosol_pressure,
      static_cast<long long>(world.state.clock.accepted),
      static_cast<long long>(world.state.clock.rejected), world.state.balance.momentum,
      world.state.balance.torque);
  EXPECT_EQ(world.state.clock.accepted, 700);  // of 2 s
  EXPECT_EQ(world.state.clock.rejected, 0);
  EXPECT_GT(late.area, 20);
  EXPECT_LT(late.distance, kApart);
  EXPECT_NEAR(late.distance, soon.distance, 0.05);  // a facet more or less
  EXPECT_NEAR(late.area, soon.area, 0.1 * late.area);
  EXPECT_GT(late.cell[0].cytosol_pressure, 0);
  EXPECT_LT(world.state.balance.momentum, 1e-9);  // as of the other law
  EXPECT_LT(world.state.balance.torque, 1e-9);
  for (const CellMeasure& m : late.cell) {
    EXPECT_EQ(m.contacts, 1);
    // Both see the same contact: its area on the contact planes, less where those are oblique.
    EXPECT_NEAR(m.contact_area, late.area, 0.05 * late.area);
    EXPECT_NEAR(m.contact_force, late.cell[0].contact_force, 1e-12);
  }
}

// Both models against each other, from several directions: force and moment.
TEST(TriangleContactSteps, ForcesAcrossTheInterfaceBalance) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0.35682, 0, 0.93417), Vec3(1, 1, 1)}) {
    World world = make_test_world({{Vec3::Zero()}, {23.5 * direction.normalized(), false}});
    world.params.dcm_contact.law = dcm::ContactLaw::kMaugisDugdale;
    SizedWorkspace work(world);
    assemble(world, 1.0, work);
    RowVector<double> with = work.system.force;
    assemble(world, 1.0, work, {.interface = false});
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double sizes = 0, moments = 0;
    const std::size_t split = cbm_first_row(world.state) * kPointStride;
    for (std::size_t row = 0; row < work.system.n_row; ++row)
      for (int l = 0; l < kLanes; ++l) {
        const Address a = make_address(row, l);
        const Vec3 f = load_point(with.data(), a) - load_point(work.system.force.data(), a);
        const Vec3 x = a < split ? load_point(world.state.dcm.position.data(), a)
                                 : cbm::center_of(world.state.cbm, 0);
        force += f;
        moment += x.cross(f);
        sizes += f.norm();
        moments += x.cross(f).norm();
      }
    EXPECT_GT(sizes, 1e-2);
    EXPECT_LT(force.norm(), 1e-12 * sizes);
    EXPECT_LT(moment.norm(), 1e-12 * moments);
  }
}

// A round cell and a sphere: the curve with the modulus of the sphere in series.
TEST(TriangleContactSteps, ASphereIsMetAsABall) {
  const double overlap = 0.4;
  World world = make_test_world({{Vec3::Zero()}, {Vec3(24 - overlap, 0, 0), false}}, 60, 642);
  world.params.dcm_contact.law = dcm::ContactLaw::kMaugisDugdale;
  for (int i = 0; i < 642; ++i) {
    double* x = world.state.dcm.position.data();
    const Address a = dcm::node_address(world.state.dcm, 0, i);
    store_point(x, a, 12 * load_point(x, a).normalized());
  }
  SizedWorkspace work(world);
  assemble(world, 1.0, work);
  double push = 0, area = 0;
  for (const contact::Contact& k : work.contacts.interface()) {
    push += k.force;
    area += k.touching;
  }
  const double nu = world.params.cbm[0].poisson;
  const double sphere = world.state.cbm.young[0] / (1 - nu * nu);
  const double modulus = 1 / (1 / world.params.dcm_contact.modulus + 1 / sphere);
  const double adhesion = std::sqrt(world.params.dcm[0].adhesion * world.params.cbm[0].adhesion);
  const contact::MaugisPoint exact =
      contact::maugis_at_overlap({{6, modulus, adhesion}, adhesion / 0.02}, overlap);
  std::printf("a cell against a sphere: %.4f of the curve, area %.4f\n", push / exact.force,
              area / (kPi * exact.cohesive_radius * exact.cohesive_radius));
  EXPECT_NEAR(push, exact.force, 0.01 * std::abs(exact.force));
}

/// Deepest node or middle of a triangle of a cell in a vessel along x through the origin, um.
double depth_in_vessel(const World& world, double radius) {
  std::vector<Vec3> place;
  dcm::copy_nodes(world.state.dcm, 0, place);
  for (const auto& f : world.state.dcm.group[0].topology->triangle)
    place.push_back((place[f[0]] + place[f[1]] + place[f[2]]) / 3);
  double deepest = 0;
  for (const Vec3& x : place) deepest = std::max(deepest, radius - std::hypot(x.y(), x.z()));
  return deepest;
}

/// The same of one cell of 162 nodes, some time after a force began to pull it onto a sinusoid.
/// @param force  nN
/// @param time   s
double depth_of_pulled_cell(dcm::ContactLaw law, double force, double time) {
  constexpr double kSinusoid = 4.7;  // um
  World w = make_test_world({{Vec3(0, 0.3, 12 + kSinusoid), true, Vec3(0, 0, -force)}}, 10);
  w.params.dcm_contact.law = law;
  geometry::Network network;
  network.node = {Vec3(-60, 0, 0), Vec3(60, 0, 0)};
  network.segment = {{0, 1}};
  network.radius = {{kSinusoid, kSinusoid}};
  contact::set_network(w.params.boundary.vessels, network);
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, time));
  return depth_in_vessel(w, kSinusoid);
}

// A cell that is pulled onto a thin vessel is hollow there. The paper's law holds it as the default
// one does, whose wall yields in the same way. With R^ of up to 1 mm it was three times as deep.
TEST(TriangleContactSteps, AVesselHoldsACellThatIsPulledOntoIt) {
  for (const auto& [force, time] : {std::pair(1.0, 2400.0), std::pair(6.0, 600.0)}) {
    const double md = depth_of_pulled_cell(dcm::ContactLaw::kMaugisDugdale, force, time),
                 cohesive = depth_of_pulled_cell(dcm::ContactLaw::kCohesive, force, time);
    std::printf("%g nN: %.3f um deep in a vessel, %.3f um with the cohesive law\n", force, md,
                cohesive);
    EXPECT_GT(cohesive, 0.05);
    EXPECT_LT(md, 1.5 * cohesive);
  }
}

// With one place a force, or with extrapolated steps, the cell moved to and fro from step to step.
TEST(TriangleContactSteps, ACompressedCellTakesFullStepsAndComesToRest) {
  World w = make_test_world({{Vec3::Zero()}}, 60);
  w.params.dcm_contact.law = dcm::ContactLaw::kMaugisDugdale;
  w.params.boundary.capsules.push_back(
      {.name = "capsule", .radius = 12.2, .speed = 1e-4, .min_radius = 11.6, .material = {}});
  w.params.numerics.adaptive = w.params.numerics.extrapolate = true;
  w.params.numerics.tolerance = 0.1;
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, 2.5 * 3600));
  double largest = 0;
  for (int n = 0; n < 5; ++n) {
    const StepResult step = take_step(w, work, 60);
    largest = std::max(largest, step.max_move);
  }
  std::printf("in a capsule: %lld steps, then moves of %.4f um\n",
              static_cast<long long>(w.state.clock.accepted), largest);
  EXPECT_LT(w.state.clock.accepted, 170);  // 150 of 60 s
  EXPECT_LT(largest, 0.01);
}

// The first steps: later the jumps of the force part what round-off has parted.
TEST(TriangleContactSteps, TurnAndShiftWithTheCells) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vec3 shift(31, -8, 5);
  World here = make_pair(Mat3::Identity(), Vec3::Zero()), there = make_pair(turn, shift);
  for (World* w : {&here, &there}) w->params.numerics.cg.tolerance = 1e-10;
  const PairAtRest p = settle(here, 6), q = settle(there, 6);
  double worst = 0;
  for (std::size_t k = 0; k < 2; ++k)
    worst = std::max(worst, (turn * p.cell[k].center + shift - q.cell[k].center).norm());
  std::printf("turned and shifted: centres %.1e um, area %.1e um^2\n", worst, q.area - p.area);
  EXPECT_GT(p.area, 1);
  // Elements of the matrix are floats and the solve has 1e-10: 1e-7 of moves of 0.1 um a step, with
  // stresses that grow by sigma0/h0 on the way.
  EXPECT_LT(worst, 1e-5);
  EXPECT_NEAR(q.area, p.area, 1e-3 * p.area);
}

}  // namespace
}  // namespace acinus::coupling
