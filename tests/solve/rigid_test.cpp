#include "solve/rigid.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "solve/cg.hpp"
#include "tests/solve/systems.hpp"

namespace acinus::solve {
namespace {

/// nN/um, gamma / h of a cell in a liquid (5e-7 nN s/um^3, R 10 um, 60 s) against contacts of
/// order 1.
constexpr double kMedium = 1e-5;

/// Two clusters of spheres, joined inside by links along the line of centres (which resist no rigid
/// motion), next to three lanes without a cell.
struct Clusters {
  System system;
  Operator op;
  std::vector<double> position, rhs, x;
  std::vector<std::uint8_t> active = std::vector<std::uint8_t>(2 * kLanes, 1);
  std::vector<int> cluster;  ///< [cell]
  CgWorkspace cg;
  RigidWorkspace work;

  Clusters() {
    auto random = reference::stream(30);
    set_blocks(system, {block_of(kSingle), block_of(kSingle)});
    position.resize(system.n_dof());
    rhs.resize(system.n_dof());
    x.resize(system.n_dof());
    for (int c = 0; c < 2 * kLanes; ++c) {
      cluster.push_back(c < 6 ? 0 : c < 13 ? 1 : -1);
      active[c] = c < 13 ? 1 : 0;
      const double medium = c < 13 ? kMedium : 1;
      const std::size_t row = c / kLanes, l = c % kLanes;
      system.medium[row * kLanes + l] = medium;
      store_point(position.data(), at(c),
                  Vec3(c < 6 ? 0 : 60, 0, 0) + reference::random_vector(random, 15));
      if (c < 13) store_point(rhs.data(), at(c), reference::random_vector(random, 1e-4));
    }
    for (int a = 0; a < 13; ++a)
      for (int b = 0; b < a; ++b) {
        if (cluster[a] != cluster[b]) continue;
        const Vec3 u = (place(a) - place(b)).normalized(), pull = random.uniform(-0.1, 0.1) * u;
        add_link(point(a), point(b), random.uniform(0.5, 2), 0, u);
        add_point(rhs.data(), at(a), pull);
        add_point(rhs.data(), at(b), -pull);
      }
    op.prepare(system);
  }
  static Point point(int c) { return static_cast<Point>(c); }
  static Address at(int c) { return address_of(point(c)); }
  /// Contacts of odd cells with those before them are of surfaces, which with one point a side is
  /// the same thing: the last cell of each cluster belongs to it by one kind only.
  void add_link(Point a, Point b, double stiffness, double friction, const Vec3& normal) {
    Link link;
    link.a = Side::at(a);
    link.b = b == kNowhere ? Side::nowhere() : Side::at(b);
    set_law(stiffness, friction, 0, normal, link);
    if (a % 2 == 1) {
      system.links.link.push_back(link);
      system.links.law.push_back({});
    } else {
      system.point_links.push_back({a, b, link.normal, link.stiffness, link.friction});
    }
  }
  Vec3 place(int c) const { return load_point(position.data(), at(c)); }
  Vec3 center(int k) const {
    Vec3 sum = Vec3::Zero();
    int n = 0;
    for (int c = 0; c < 13; ++c)
      if (cluster[c] == k) sum += place(c), ++n;
    return sum / n;
  }
  /// Force and torque of a field on one cluster.
  Eigen::Matrix<double, 6, 1> resultant(const std::vector<double>& f, int k) const {
    Eigen::Matrix<double, 6, 1> out = Eigen::Matrix<double, 6, 1>::Zero();
    for (int c = 0; c < 13; ++c) {
      if (cluster[c] != k) continue;
      out.head<3>() += load_point(f.data(), at(c));
      out.tail<3>() += (place(c) - center(k)).cross(load_point(f.data(), at(c))) / 15;
    }
    return out;
  }
  std::vector<double> residual() const {
    std::vector<double> r(x.size());
    op.apply(x, r);
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = rhs[k] - r[k];
    return r;
  }
  RigidResult correct(double threshold) {
    std::vector<double> product(x.size());
    return correct_rigid_modes(op, {residual(), product}, x, {position, active}, threshold, work);
  }
};

/// Part of a displacement that no rigid motion explains, by least squares.
double distance_from_rigid(const Clusters& c, const std::vector<double>& move, int k) {
  std::vector<int> cell;
  for (int i = 0; i < 13; ++i)
    if (c.cluster[i] == k) cell.push_back(i);
  Eigen::MatrixXd z(3 * cell.size(), 6);
  Eigen::VectorXd m(3 * cell.size());
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    z.block<3, 3>(row, 0).setIdentity();
    for (int axis = 0; axis < 3; ++axis)
      z.block<3, 1>(row, 3 + axis) = Vec3::Unit(axis).cross(c.place(cell[i]) - c.center(k));
    m.segment<3>(row) = load_point(move.data(), Clusters::at(cell[i]));
  }
  return (m - z * z.colPivHouseholderQr().solve(m)).cwiseAbs().maxCoeff();
}

TEST(RigidModes, LooseSolveIsCorrectedExactly) {
  Clusters c;
  ASSERT_TRUE(solve_cg({c.op, c.rhs}, c.x, {1e-2, 2000}, c.cg).status.ok);
  const std::vector<double> loose = c.x;
  const std::vector<double> before = c.residual();
  const RigidResult result = c.correct(1e-6);
  EXPECT_EQ(result.corrected_groups, 2);
  const std::vector<double> after = c.residual();
  std::vector<double> move(c.x.size());
  for (std::size_t k = 0; k < move.size(); ++k) move[k] = c.x[k] - loose[k];
  for (int k : {0, 1}) {
    const double load = c.resultant(c.rhs, k).norm();
    const double relative = c.resultant(after, k).norm() / load;
    std::printf("cluster %d: rigid residual %.1e before, %.1e after (of its load)\n", k,
                c.resultant(before, k).norm() / load, relative);
    EXPECT_GT(c.resultant(before, k).norm() / load, 1e-3)
        << "nothing to correct: the test says nothing";
    EXPECT_LT(relative, 1e-9);
    EXPECT_LT(distance_from_rigid(c, move, k), 1e-12 * result.largest_move + 1e-14);
  }
  for (int cell = 13; cell < 16; ++cell)
    EXPECT_EQ(load_point(c.x.data(), Clusters::at(cell)),
              load_point(loose.data(), Clusters::at(cell)));
  double largest = 0;
  for (int cell = 0; cell < 13; ++cell)
    largest = std::max(largest, load_point(move.data(), Clusters::at(cell)).norm());
  EXPECT_GE(result.largest_move, largest * (1 - 1e-12));
  std::printf("largest correction %.3g um\n", largest);
}

TEST(RigidModes, ErrorBelowTheThresholdIsLeftAlone) {
  Clusters c;
  ASSERT_TRUE(solve_cg({c.op, c.rhs}, c.x, {1e-2, 2000}, c.cg).status.ok);
  const std::vector<double> loose = c.x;
  const RigidResult result = c.correct(1e6);
  EXPECT_EQ(result.corrected_groups, 0);
  EXPECT_EQ(result.largest_move, 0);
  EXPECT_EQ(c.x, loose);
  // Already corrected: nothing is left above a nanometre.
  c.correct(1e-6);
  const std::vector<double> once = c.x;
  EXPECT_EQ(c.correct(1e-3).corrected_groups, 0);
  EXPECT_EQ(c.x, once);
}

// Only the cluster that drifted is touched.
TEST(RigidModes, ClustersAreJudgedApart) {
  Clusters c;
  ASSERT_TRUE(solve_cg({c.op, c.rhs}, c.x, {1e-13, 20000}, c.cg).status.ok);
  c.correct(0);
  const std::vector<double> exact = c.x;
  for (int cell = 0; cell < 6; ++cell)
    add_point(c.x.data(), Clusters::at(cell),
              Vec3(1, 2, 3) + Vec3(0.01, 0, -0.02).cross(c.place(cell)));
  EXPECT_EQ(c.correct(0.01).corrected_groups, 1);
  for (int cell = 0; cell < 13; ++cell) {
    const Vec3 error =
        load_point(c.x.data(), Clusters::at(cell)) - load_point(exact.data(), Clusters::at(cell));
    if (cell < 6)
      EXPECT_LT(error.norm(), 1e-5);
    else
      EXPECT_EQ(error.norm(), 0);
  }
}

// A contact with boundary holds the cluster: it belongs into the projected matrix, else the
// correction would throw the cluster about. [decisions: 6x6 with the boundary' stiffness]
TEST(RigidModes, BoundaryHoldsACluster) {
  Clusters c;
  for (int cell = 0; cell < 6; ++cell) {
    c.add_link(Clusters::point(cell), kNowhere, 3, 1e-3, Vec3::UnitZ());
  }
  c.op.prepare(c.system);
  ASSERT_TRUE(solve_cg({c.op, c.rhs}, c.x, {1e-2, 2000}, c.cg).status.ok);
  c.correct(0);
  const std::vector<double> after = c.residual();
  for (int k : {0, 1})
    EXPECT_LT(c.resultant(after, k).norm(), 1e-9 * c.resultant(c.rhs, k).norm()) << k;
}

// Isotropic pair friction resists rigid rotation of a cluster of spheres: it must be in the matrix
// too.
TEST(RigidModes, FrictionOfPairsIsSeen) {
  Clusters c;
  for (Link& l : c.system.links.link) l.friction = 0.5f;
  for (PointLink& l : c.system.point_links) l.friction = 0.5f;
  c.op.prepare(c.system);
  ASSERT_TRUE(solve_cg({c.op, c.rhs}, c.x, {1e-2, 2000}, c.cg).status.ok);
  c.correct(0);
  const std::vector<double> after = c.residual();
  for (int k : {0, 1}) {
    std::printf("cluster %d with pair friction: %.1e\n", k,
                c.resultant(after, k).norm() / c.resultant(c.rhs, k).norm());
    EXPECT_LT(c.resultant(after, k).norm(), 1e-9 * c.resultant(c.rhs, k).norm());
  }
}

}  // namespace
}  // namespace acinus::solve
