/// Loads of the springs that hold centroids of cells.

#include "coupling/subworld/center_hold.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "dcm/loads/loads.hpp"
#include "geometry/measures.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::coupling {
namespace {

using namespace dcm;

constexpr double kStiffness = 1e4;  // nN/um
const Vec3 kShift(0.3, -0.2, 0.1);  // um, of the held places from the centroids

Vec3 centroid(const Cells& c, std::size_t lane) {
  std::vector<Vec3> node;
  copy_nodes(c.state, lane, node);
  return geometry::compute_centroid(node, c.state.group[0].topology->triangle);
}

/// Deformed cells, that of one lane held beside its centroid.
struct Fixture {
  Cells c = make_deformed_cells();
  std::size_t lane = 2;
  Vec3 place = centroid(c, lane) + kShift;

  void add() {
    size_rank_one(c.state, {}, c.system, 3);
    const CenterHold hold({{c.state.lineage[lane], place}});
    hold.add_loads(0, {c.state, c.lanes, c.system}, c.system.rank_one);
  }
};

TEST(CenterHold, ForceIsMinusTheGradientOfItsEnergy) {
  Fixture f;
  f.add();
  const double step = 1e-4;
  for (const int i : {0, 7, 100})
    for (int axis = 0; axis < 3; ++axis) {
      const auto energy = [&](double by) {
        Cells d = f.c;
        d.move(f.lane, i, f.c.node(f.lane, i) + by * Vec3::Unit(axis));
        return 0.5 * kStiffness * (centroid(d, f.lane) - f.place).squaredNorm();
      };
      const double expected = -(energy(step) - energy(-step)) / (2 * step);
      EXPECT_NEAR(load_of(f.c, f.lane, i)[axis], expected, 1e-6 * std::abs(expected) + 1e-5);
    }
}

TEST(CenterHold, SumsToTheForceOfTheSpringAndTurnsNothing) {
  Fixture f;
  f.add();
  reference::NetForce net;
  const Vec3 middle = centroid(f.c, f.lane);
  for (int i = 0; i < f.c.n_node(); ++i)
    net.add(load_of(f.c, f.lane, i), f.c.node(f.lane, i) - middle);
  EXPECT_NEAR((net.force - kStiffness * kShift).norm(), 0, 1e-8);
  EXPECT_NEAR(net.torque.norm(), 0, 1e-6);
}

TEST(CenterHold, StiffnessIsThatOfItsEnergy) {
  Fixture f;
  f.add();
  const Eigen::MatrixXd matrix = lane_matrices(f.c)[f.lane];
  // A common translation stretches the springs as a whole.
  Eigen::VectorXd shift(3 * f.c.n_node());
  for (int i = 0; i < f.c.n_node(); ++i) shift.segment<3>(3 * i) = kShift;
  EXPECT_NEAR(shift.dot(matrix * shift), kStiffness * kShift.squaredNorm(),
              1e-5 * kStiffness * kShift.squaredNorm());
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(),
            -1e-6 * matrix.norm());
}

TEST(CenterHold, TurnsWithTheCell) {
  Fixture f, g;
  auto random = reference::stream(8);
  const Mat3 turn = reference::random_rotation(random);
  const Vec3 by(3, -40, 20);
  for (int i = 0; i < f.c.n_node(); ++i) g.c.move(g.lane, i, turn * f.c.node(f.lane, i) + by);
  g.place = turn * f.place + by;
  f.add();
  g.add();
  for (int i = 0; i < f.c.n_node(); ++i)
    EXPECT_NEAR((turn * load_of(f.c, f.lane, i) - load_of(g.c, g.lane, i)).norm(), 0, 1e-8);
}

TEST(CenterHold, LeavesOtherCellsAlone) {
  Fixture f;
  f.add();
  for (const std::size_t lane : {0, 1, 7}) {
    EXPECT_EQ(f.c.system.rank_one[0].coefficient[lane], 0);
    for (int i = 0; i < f.c.n_node(); ++i) EXPECT_EQ(load_of(f.c, lane, i), Vec3::Zero());
  }
}

}  // namespace
}  // namespace acinus::coupling
