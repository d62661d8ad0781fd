/// Loads of a spring at the centre of a cell.

#include "coupling/apparatus/pull/pull_spring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "dcm/loads/loads.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::coupling {
namespace {

using namespace dcm;

using Springs = std::array<PullSpring, kLanes>;

/// Deformed cells with room for the springs in their system, and nothing else in it.
Cells make_cells() {
  Cells c = make_deformed_cells();
  size_rank_one(c.state, {}, c.system, 1);
  solve::clear_loads(c.system);
  return c;
}

Springs same_in_all(const PullSpring& spring) {
  Springs s;
  s.fill(spring);
  return s;
}

void add(Cells& c, const Springs& spring) {
  add_pull_springs(c.view(), spring, c.system, c.system.rank_one.back());
}

double energy(const Cells& c, std::size_t lane, const PullSpring& s) {
  const double stretch = s.direction.dot(cell_center(c.state, lane)) - s.end;
  return 0.5 * s.stiffness * stretch * stretch;
}

TEST(PullSpring, ForceIsMinusTheGradientOfItsEnergy) {
  Cells c = make_cells();
  const PullSpring spring{Vec3(1, -2, 2) / 3, 0.7, 5};
  add(c, same_in_all(spring));
  const double step = 1e-3;  // the energy is a square: central differences are exact
  for (const std::size_t lane : {0, 5})
    for (const int i : {0, 7, 100})
      for (int axis = 0; axis < 3; ++axis) {
        Cells d = c;
        const auto at = [&](double by) {
          d.move(lane, i, c.node(lane, i) + by * Vec3::Unit(axis));
          return energy(d, lane, spring);
        };
        EXPECT_NEAR(load_of(c, lane, i)[axis], -(at(step) - at(-step)) / (2 * step), 1e-9);
      }
}

TEST(PullSpring, SumsToTheForceOfTheSpring) {
  Cells c = make_cells();
  const PullSpring spring{Vec3::UnitY(), 0.7, 5};
  add(c, same_in_all(spring));
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < c.n_node(); ++i) sum += load_of(c, 1, i);
  const double force = 0.7 * (5 - cell_center(c.state, 1).y());
  EXPECT_NEAR((sum - force * Vec3::UnitY()).norm(), 0, 1e-12);
}

// A square's second derivative is its stiffness: moved by x the force changes by - K x.
TEST(PullSpring, StiffnessIsTheChangeOfItsForce) {
  Cells c = make_cells();
  const Springs spring = same_in_all({Vec3(2, 1, -2) / 3, 0.7, 5});
  add(c, spring);
  const std::vector<Eigen::MatrixXd> matrix = lane_matrices(c);
  auto random = reference::stream(3);
  Cells d = make_cells();
  Eigen::VectorXd by(3 * c.n_node()), change(by.size());
  for (int i = 0; i < c.n_node(); ++i) {
    by.segment<3>(3 * i) = reference::random_vector(random, 1);
    d.move(2, i, c.node(2, i) + by.segment<3>(3 * i));
  }
  add(d, spring);
  for (int i = 0; i < c.n_node(); ++i)
    change.segment<3>(3 * i) = load_of(d, 2, i) - load_of(c, 2, i);
  EXPECT_NEAR((matrix[2] * by + change).norm(), 0, 1e-6 * change.norm());  // kept as floats
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix[2]).eigenvalues().minCoeff(),
            -1e-7);
}

TEST(PullSpring, TurnsWithTheCell) {
  Cells c = make_cells(), d = c;
  auto random = reference::stream(8);
  const Mat3 turn = reference::random_rotation(random);
  const Vec3 shift(3, -40, 20), direction = Vec3(1, 2, 2) / 3;
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) d.move(l, i, turn * c.node(l, i) + shift);
  add(c, same_in_all({direction, 0.7, 5}));
  add(d, same_in_all({turn * direction, 0.7, 5 + (turn * direction).dot(shift)}));
  for (int i = 0; i < c.n_node(); ++i)
    EXPECT_NEAR((turn * load_of(c, 4, i) - load_of(d, 4, i)).norm(), 0, 1e-12);
}

TEST(PullSpring, LeavesCellsWithoutOneAlone) {
  Cells c = make_cells();
  Springs spring = same_in_all({});
  spring[1] = {Vec3::UnitX(), 1, 100};
  add(c, spring);
  for (const std::size_t lane : {0, 2, 7}) {
    EXPECT_EQ(c.system.rank_one.back().coefficient[lane], 0);
    for (int i = 0; i < c.n_node(); ++i) EXPECT_EQ(load_of(c, lane, i), Vec3::Zero());
  }
}

}  // namespace
}  // namespace acinus::coupling
