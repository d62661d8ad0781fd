/// Flexible vessels: against beams and tubes, and with cells.

#include "coupling/vessels/vessel_tree.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <vector>

#include "geometry/edit_network.hpp"
#include "tests/coupling/worlds.hpp"
#include "tests/reference/dense_system.hpp"

namespace acinus::coupling {
namespace {

const TubeMaterial kSinusoid{0.6, 0.4, 1, 0, 0.1};
constexpr double kVesselRadius = 4;

/// Straight vessel from the origin along a direction, in equal parts.
geometry::Network straight_vessel(double length, int parts, const Vec3& direction = Vec3::UnitX()) {
  geometry::Network n;
  n.node = {Vec3::Zero(), length * direction};
  n.segment = {{0, 1}};
  n.radius = {{kVesselRadius, kVesselRadius}};
  return geometry::split_network(n, length / parts);
}

/// Nodes that stand still, and loads on nodes, put on in equal parts.
struct Experiment {
  std::vector<int> held;
  std::vector<std::pair<int, Vec3>> force, moment;
  int parts = 1;
};

/// Tree in balance, by Newton's iteration with the matrix of the program, entry by entry.
TreeState balance(VesselTree tree, const Experiment& x) {
  tree.anchored.assign(tree.n_node(), 0);
  TreeState s = at_rest(tree);
  solve::System system;
  system.friction_scale = 0;
  solve::set_blocks(system, {{.pattern = &tree.pattern}});
  const auto n = static_cast<Eigen::Index>(tree.n_node());
  // Unknowns of the tree's lane only.
  std::vector<Eigen::Index> at;
  for (Eigen::Index row = 0; row < 2 * n; ++row) {
    if (std::ranges::find(x.held, row % n) != x.held.end()) continue;
    for (Address c = 0; c < 3; ++c)
      at.push_back(
          static_cast<Eigen::Index>(make_address(static_cast<std::size_t>(row), 0) + c * kLanes));
  }
  const auto m = static_cast<Eigen::Index>(at.size());
  for (int part = 1, iteration = 0; iteration < 3000; ++iteration) {
    const double share = static_cast<double>(part) / x.parts;
    solve::clear_loads(system);
    add_tree_loads(tree, s, system.block[0], system);
    for (const auto& [node, load] : x.force)
      add_point(system.force.data(), make_address(static_cast<std::size_t>(node), 0), share * load);
    for (const auto& [node, load] : x.moment)
      add_point(system.force.data(), make_address(static_cast<std::size_t>(n + node), 0),
                share * load);
    const Eigen::MatrixXd all = reference::make_dense(system);
    Eigen::MatrixXd k(m, m);
    Eigen::VectorXd f(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      f[i] = system.force[static_cast<std::size_t>(at[i])];
      for (Eigen::Index j = 0; j < m; ++j) k(i, j) = all(at[i], at[j]);
    }
    const Eigen::VectorXd step = k.ldlt().solve(f);
    std::vector<double> move(system.n_dof(), 0.0);
    for (Eigen::Index i = 0; i < m; ++i) move[static_cast<std::size_t>(at[i])] = step[i];
    move_tree(move, s);
    if (step.norm() < 1e-10 && ++part > x.parts) return s;
  }
  ADD_FAILURE() << "the balance was not found";
  return s;
}

TEST(VesselTree, BendsUnderLoadsAtItsEndAsABeamDoes) {
  const double length = 60, load = 1e-3;
  const Tube tube{kVesselRadius, kSinusoid.wall};
  const double bend = kSinusoid.young * tube.second_moment(),
               stretch = kSinusoid.young * tube.area();
  for (const int parts : {1, 4}) {
    const VesselTree tree =
        make_tree(straight_vessel(length, parts), kSinusoid, VesselAnchors::kNone);
    const auto tip = [&](const Vec3& force, const Vec3& moment) {
      return balance(tree, {{0}, {{1, force}}, {{1, moment}}});
    };
    const double side = tip(load * Vec3::UnitY(), Vec3::Zero()).node[1].y();
    const double pull = tip(load * Vec3::UnitX(), Vec3::Zero()).node[1].x() - length;
    const TreeState twisted = tip(Vec3::Zero(), load * Vec3::UnitX());
    const double twist = Eigen::AngleAxisd(twisted.rotation[1]).angle();
    const double side_said = load * std::pow(length, 3) / (3 * bend);
    const double pull_said = load * length / stretch;
    const double twist_said = load * length * (1 + kSinusoid.poisson) / bend;  // G J = E I / (1+nu)
    std::printf("%d parts: side %.5g of %.5g um, end %.4g of %.4g, twist %.4g of %.4g\n", parts,
                side, side_said, pull, pull_said, twist, twist_said);
    EXPECT_NEAR(side, side_said, 1e-3 * side_said);
    EXPECT_NEAR(pull, pull_said, 1e-3 * pull_said);
    EXPECT_NEAR(twist, twist_said, 1e-3 * twist_said);
  }
}

TEST(VesselTree, BendsUnderALoadInItsMiddleAsAClampedBeamDoes) {
  const double length = 60, load = 2e-3;
  const double bend = kSinusoid.young * Tube{kVesselRadius, kSinusoid.wall}.second_moment();
  const VesselTree tree = make_tree(straight_vessel(length, 2), kSinusoid, VesselAnchors::kEnds);
  const TreeState s = balance(tree, {{0, 1}, {{2, load * Vec3::UnitZ()}}, {}});
  const double said = load * std::pow(length, 3) / (192 * bend);
  EXPECT_NEAR(s.node[2].z(), said, 1e-3 * said);
}

/// Beam bent by a moment into a full circle: rotations of 360 degrees in all.
TEST(VesselTree, BendsIntoACircle) {
  const double length = 60;
  const int parts = 24;
  const double bend = kSinusoid.young * Tube{kVesselRadius, kSinusoid.wall}.second_moment();
  const VesselTree tree =
      make_tree(straight_vessel(length, parts), kSinusoid, VesselAnchors::kNone);
  const double moment = 2 * kPi * bend / length;
  const TreeState s = balance(tree, {{0}, {}, {{1, moment * Vec3::UnitZ()}}, 40});
  std::printf("the end of a circle is %.3g um from its beginning, circumference %.3g um\n",
              s.node[1].norm(), length);
  EXPECT_LT(s.node[1].norm(), 0.02 * length);
}

/// Elbow that is loaded across its plane: the far leg bends, the near leg bends and twists.
TEST(VesselTree, JointsCarryBendingAndTwist) {
  const double leg = 40, load = 1e-3;
  geometry::Network n;
  n.node = {Vec3::Zero(), Vec3(leg, 0, 0), Vec3(leg, leg, 0)};
  n.segment = {{0, 1}, {1, 2}};
  n.radius = {{kVesselRadius, kVesselRadius}, {kVesselRadius, kVesselRadius}};
  const VesselTree tree = make_tree(n, kSinusoid, VesselAnchors::kNone);
  const TreeState s = balance(tree, {{0}, {{2, load * Vec3::UnitZ()}}, {}});
  const double bend = kSinusoid.young * Tube{kVesselRadius, kSinusoid.wall}.second_moment();
  const double said =
      load * std::pow(leg, 3) * (2.0 / 3 + 1 + kSinusoid.poisson) / bend;  // bends twice, twists
  EXPECT_NEAR(s.node[2].z(), said, 2e-3 * said);
}

TEST(VesselTree, HoldsWhatNothingElseHolds) {
  geometry::Network n = straight_vessel(60, 3);
  n.node.push_back(Vec3(0, 50, 0));  // without a segment
  for (const VesselAnchors anchors : {VesselAnchors::kEnds, VesselAnchors::kNone}) {
    const VesselTree tree = make_tree(n, kSinusoid, anchors);
    EXPECT_TRUE(tree.has_ends());
    const std::uint8_t end = anchors == VesselAnchors::kEnds ? 1 : 0;
    EXPECT_EQ(tree.anchored, (std::vector<std::uint8_t>{end, end, 0, 0, 1}));
  }
  geometry::Network ring;
  ring.node = {Vec3::Zero(), Vec3(20, 0, 0), Vec3(0, 20, 0)};
  ring.segment = {{0, 1}, {1, 2}, {2, 0}};
  ring.radius.assign(3, {kVesselRadius, kVesselRadius});
  EXPECT_FALSE(make_tree(ring, kSinusoid, VesselAnchors::kEnds).has_ends());
}

/// Checks that a subworld has the vessels, but no nodes to move.
TEST(VesselTree, LeavesVesselsWhereTheyAreWithoutAState) {
  const geometry::Network n = straight_vessel(60, 3);
  const VesselTree tree = make_tree(n, kSinusoid, VesselAnchors::kEnds);
  contact::Vessels vessels;
  contact::set_network(vessels, n);
  vessels.network.node[2].z() = 3;
  place_vessels(tree, {}, vessels);
  EXPECT_EQ(vessels.network.node[2].z(), 3);
}

/// Cell that is pulled against the middle of a vessel.
World cell_on_vessel(bool deformable, const TubeMaterial& material, double pull, bool flexible) {
  const double length = 48;
  World w =
      make_test_world({{Vec3(0, 0, kVesselRadius + 11.9), deformable, -pull * Vec3::UnitZ()}}, 120);
  geometry::Network n = straight_vessel(length, 8);
  for (Vec3& x : n.node) x.x() -= length / 2;
  contact::set_network(w.params.boundary.vessels, n);
  w.params.boundary.vessels.material = {0, material.young, material.poisson, false};
  if (flexible) {
    w.params.tree = make_tree(n, material, VesselAnchors::kEnds);
    w.state.tree = at_rest(w.params.tree);
  }
  w.state.clock.phase = Phase::kRun;
  return w;
}

/// Floating vessels: nothing but friction holds them, and they go where a cell pushes them.
TEST(VesselTree, FloatsWithoutAnchors) {
  World w = cell_on_vessel(false, kSinusoid, 0.05, true);
  w.params.tree = make_tree(w.params.tree.rest, kSinusoid, VesselAnchors::kNone);
  SizedWorkspace work(w);
  ASSERT_TRUE(run_until(w, work, 20 * 3600));
  double highest = -1e9;
  for (const Vec3& x : w.state.tree.node) highest = std::max(highest, x.z());
  std::printf("after 20 h all of it is at least %.3g um lower\n", -highest);
  EXPECT_LT(highest, -0.5);
}

TEST(VesselTree, ActsOnCellsAsTheyActOnIt) {
  for (const bool deformable : {true, false}) {
    World w = cell_on_vessel(deformable, kSinusoid, 0.1, true);
    SizedWorkspace work(w);
    ASSERT_TRUE(run_until(w, work, 1200));
    assemble(w, 1, work);
    Vec3 on_cell = Vec3::Zero(), on_tree = Vec3::Zero(), torque = Vec3::Zero();
    double size = 0, torques = 0;
    const std::vector<double> x = gather_positions(w.state);
    const std::size_t first = tree_first_row(w.state), n = w.params.tree.n_node();
    for (std::size_t row = 0; row < work.system.n_row; ++row)
      for (int l = 0; l < kLanes; ++l) {
        const Address a = make_address(row, l);
        const Vec3 f = load_point(work.system.force.data(), a);
        if (row >= first + n) {
          torque += f;
          torques += f.norm();
          continue;
        }
        (row < first ? on_cell : on_tree) += f;
        size += f.norm();
        const Vec3 turn = load_point(x.data(), a).cross(f);
        torque += turn;
        torques += turn.norm();
      }
    std::printf("%s: %.3g nN on the cell, sum %.2g of all forces, torque %.2g\n",
                deformable ? "DCM" : "CBM", on_cell.norm(), (on_cell + on_tree).norm() / size,
                torque.norm() / torques);
    EXPECT_GT(on_cell.z(), 1e-3);
    EXPECT_LT((on_cell + on_tree).norm(), 1e-12 * size);
    // Weights of places are floats.
    EXPECT_LT(torque.norm(), 1e-6 * torques);
  }
}

/// Contact of a sphere with both segments of a joint: together they act like one segment as long as
/// they are nearly straight.
TEST(VesselTree, TouchesASphereOnceAtAJointThatBends) {
  const auto force = [](double angle) {
    TubeMaterial material = kSinusoid;
    material.poisson = 0;  // arms that grow longer keep their radius
    World w = cell_on_vessel(false, material, 0, true);
    w.state.cbm.position[2 * kLanes] =
        (kVesselRadius + 10.9) / std::cos(angle);  // z: as near to both
    for (Vec3& x : w.state.tree.node) x.z() = std::tan(angle) * std::abs(x.x());
    SizedWorkspace work(w);
    assemble(w, 1, work);
    double sum = 0;
    for (const contact::Contact& k : work.contacts.all) sum += k.force * k.normal.z();
    return sum;
  };
  const double straight = force(0);
  EXPECT_GT(straight, 0.01);
  double before = straight;
  for (double angle = 1e-4; angle < 0.7; angle += 0.01) {
    const double now = force(angle);
    EXPECT_NEAR(now, before, 0.08 * straight) << angle;
    EXPECT_LT(now, 2 * straight);
    before = now;
  }
  std::printf(
      "a joint bent by 1e-4 rad pushes %.4f of a straight one, by 0.05 rad %.4f, 0.6 rad %.4f\n",
      force(1e-4) / straight, force(0.05) / straight, force(0.6) / straight);
  EXPECT_NEAR(force(1e-4), straight, 1e-3 * straight);
  EXPECT_NEAR(force(0.6), 2 * std::cos(0.6) * straight, 1e-6 * straight);
}

TEST(VesselTree, BendsUnderACellAsMuchAsItPulls) {
  const double pull = 0.05, length = 48;
  const double bend = kSinusoid.young * Tube{kVesselRadius, kSinusoid.wall}.second_moment();
  const double said = pull * std::pow(length, 3) / (192 * bend);
  World w = cell_on_vessel(false, kSinusoid, pull, true);
  SizedWorkspace work(w);
  ASSERT_TRUE(run_until(w, work, 20 * 3600));
  double lowest = 0;
  for (const Vec3& x : w.state.tree.node) lowest = std::min(lowest, x.z());
  std::printf("the middle went down %.4g um, a clamped beam %.4g\n", -lowest, said);
  EXPECT_NEAR(-lowest, said, 0.05 * said);
  EXPECT_NEAR(largest_displacement(w.params.tree, w.state.tree), -lowest, 1e-9);
}

/// Rigid limit: the stiffer the tubes, the less they move, and the nearer cells are to where rigid
/// vessels hold them: E of the wall that yields is the same in both.
TEST(VesselTree, StiffTubesAreRigidVessels) {
  for (const bool deformable : {true, false}) {
    World rigid = cell_on_vessel(deformable, kSinusoid, 0.1, false);
    SizedWorkspace rigid_work(rigid);
    ASSERT_TRUE(run_until(rigid, rigid_work, 3600));
    const std::vector<double> at = gather_positions(rigid.state);
    double before = 0;
    for (const double stiffer : {1e1, 1e2, 1e3, 1e5}) {
      TubeMaterial tube = kSinusoid;
      tube.young *= stiffer;
      World w = cell_on_vessel(deformable, tube, 0.1, true);
      w.params.boundary.vessels.material.young = kSinusoid.young;
      SizedWorkspace work(w);
      ASSERT_TRUE(run_until(w, work, 3600));
      const std::vector<double> x = gather_positions(w.state);
      double apart = 0;
      for (std::size_t k = 0; k < at.size(); ++k) apart = std::max(apart, std::abs(x[k] - at[k]));
      std::printf("%s: tubes %.0e times as stiff: %.3g um from rigid\n", deformable ? "DCM" : "CBM",
                  stiffer, apart);
      if (before > 0 && before > 1e-6) {
        EXPECT_LT(apart, 0.5 * before);
      }
      before = apart;
    }
    EXPECT_LT(before, 3e-4);  // what the solver leaves
  }
}

}  // namespace
}  // namespace acinus::coupling
