/// Two faces of an edge cannot be folded onto each other, and no face collapses.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kLane = 2;

/// Cell at rest but for one corner of one edge, which is turned about the edge until the normals
/// of its faces are this far apart, rad; more than pi: through each other.
Cells make_folded(double theta) {
  Cells c = make_rest_cells(geometry::shared_icosphere(42), std::vector<double>(kLanes, 10));
  const auto& h = c.state.group[0].topology->hinge[7];
  const Vec3 x1 = c.node(kLane, h[0]), x2 = c.node(kLane, h[1]), x3 = c.node(kLane, h[2]),
             axis = (c.node(kLane, h[3]) - x3).normalized();
  const Vec3 n1 = (x1 - x3).cross(x1 - c.node(kLane, h[3])),
             n2 = (x2 - c.node(kLane, h[3])).cross(x2 - x3);
  const double now = std::acos(n1.normalized().dot(n2.normalized()));
  const auto turned = [&](double angle) -> Vec3 {
    return x3 + Eigen::AngleAxisd(angle, axis) * (x1 - x3);
  };
  // Towards the inside, whichever way around that is.
  const double inward = turned(0.1).norm() < turned(-0.1).norm() ? 1 : -1;
  c.move(kLane, h[0], turned(inward * (theta - now)));
  return c;
}

double energy_of(const Cells& c) {
  return bending_energy(table_one(), c.view(), static_cast<int>(kLane));
}

TEST(Fold, TakesEverMoreEnergy) {
  double last = energy_of(make_folded(kPi / 2));
  for (double degrees = 95; degrees < 180; degrees += 5) {
    const double energy = energy_of(make_folded(degrees * kPi / 180));
    EXPECT_GT(energy, last) << degrees;
    last = energy;
  }
  // Strong adhesion, 8e-5 J/m^2 on two faces with edges of 4 um, gains 1.1 fJ.
  EXPECT_GT(energy_of(make_folded(170.0 * kPi / 180)), 1.1);
}

// A cortex a tenth as thick is a thousandth as stiff: faces keep apart as in contact then. Adhesion
// of 1e-3 J/m^2 gains 14 fJ on two faces with edges of 4 um.
TEST(Fold, OfAThinCortexIsStoppedByContact) {
  Params thin = table_one();
  thin.bending_stiffness *= 1e-3;
  const auto energy = [&](double degrees) {
    return bending_energy(thin, make_folded(degrees * kPi / 180).view(), static_cast<int>(kLane));
  };
  EXPECT_LT(energy(150) - energy(90), 0.01);
  double last = energy(154);
  for (double degrees = 156; degrees < 180; degrees += 2) {
    EXPECT_GT(energy(degrees), last) << degrees;
    last = energy(degrees);
  }
  EXPECT_GT(energy(176), 14);
  thin.fold_repulsion = 0;
  EXPECT_LT(energy(176), 1);
}

/// Cell at rest but for one corner of one face, which is moved toward the opposite edge until the
/// face has this share of its area.
Cells make_collapsed(double share) {
  Cells c = make_rest_cells(geometry::shared_icosphere(42), std::vector<double>(kLanes, 10));
  const auto& corner = c.state.group[0].topology->triangle[11];
  const Vec3 x0 = c.node(kLane, corner[0]),
             foot = 0.55 * c.node(kLane, corner[1]) + 0.45 * c.node(kLane, corner[2]);
  c.move(kLane, corner[0], foot + share * (x0 - foot));
  return c;
}

/// Compares the force with differences of the energy, and checks that the matrix is semi-definite.
void expect_consistent(Cells& c, const std::string& what) {
  add_bending(table_one(), c.view(), c.system);
  double scale = 0, worst = 0;
  for (int i = 0; i < c.n_node(); ++i) scale = std::max(scale, c.force(kLane, i).norm());
  const double h = 1e-5;  // um
  for (int i = 0; i < c.n_node(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = c.node(kLane, i);
      c.move(kLane, i, x + h * Vec3::Unit(k));
      const double more = energy_of(c);
      c.move(kLane, i, x - h * Vec3::Unit(k));
      const double less = energy_of(c);
      c.move(kLane, i, x);
      worst = std::max(worst, std::abs(c.force(kLane, i)[k] + (more - less) / (2 * h)) / scale);
    }
  std::printf("%s: force against differences %.1e of %.2g nN\n", what.c_str(), worst, scale);
  EXPECT_LT(worst, 1e-6) << what;
  const Eigen::MatrixXd k = lane_matrices(c)[kLane];
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff()) << what;
}

TEST(Fold, ForceIsMinusEnergyGradientAndStiffnessSemiDefinite) {
  for (double degrees : {110.0, 125.0, 150.0, 165.0, 172.0, 178.0, 186.0}) {
    Cells c = make_folded(degrees * kPi / 180);
    expect_consistent(c, std::to_string(static_cast<int>(degrees)) + " degrees");
  }
}

TEST(Collapse, ForceIsMinusEnergyGradientAndStiffnessSemiDefinite) {
  for (int percent : {30, 9, 5, 2}) {
    Cells c = make_collapsed(0.01 * percent);
    expect_consistent(c, std::to_string(percent) + " % of a face");
  }
}

TEST(Collapse, TakesEverMoreEnergy) {
  double last = energy_of(make_collapsed(0.1));
  for (double share : {0.08, 0.05, 0.03, 0.02, 0.01}) {
    const double energy = energy_of(make_collapsed(share));
    EXPECT_GT(energy, last) << share;
    last = energy;
  }
  // More than adhesion of 8e-5 J/m^2 gains on a face of a cell of 12 um.
  EXPECT_GT(energy_of(make_collapsed(0.005)) - energy_of(make_collapsed(0.1)), 0.5);
}

// What stands for the matrix of a collapsing face is at least as stiff as g g^T of its area.
TEST(Collapse, StiffnessIsAtLeastThatOfTheArea) {
  Cells c = make_collapsed(0.05);
  add_bending(table_one(), c.view(), c.system);
  const auto& corner = c.state.group[0].topology->triangle[11];
  Vec3 x[3];
  for (std::size_t m = 0; m < 3; ++m) x[m] = c.node(kLane, corner[m]);
  const Vec3 n = (x[1] - x[0]).cross(x[2] - x[0]);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * c.n_node());
  for (std::size_t m = 0; m < 3; ++m)
    g.segment<3>(3 * corner[m]) = 0.5 * n.normalized().cross(x[(m + 2) % 3] - x[(m + 1) % 3]);
  const double area = 0.5 * n.norm(), least = 0.1 * rest_triangle_area(c.view(), 11, kLane);
  const double curvature = 2 * table_one().bending_stiffness *
                           std::pow(least / (area * area), 2);  // 2 k_b compression'^2
  const Eigen::MatrixXd k = lane_matrices(c)[kLane];
  EXPECT_GE(g.dot(k * g), curvature * std::pow(g.squaredNorm(), 2));
}

TEST(Fold, ForceDoesNotJump) {
  const auto largest_force = [](double degrees) {
    Cells c = make_folded(degrees * kPi / 180);
    add_bending(table_one(), c.view(), c.system);
    double largest = 0;
    for (int i = 0; i < c.n_node(); ++i) largest = std::max(largest, c.force(kLane, i).norm());
    return largest;
  };
  for (double degrees = 100; degrees < 179; degrees += 0.5)
    EXPECT_NEAR(largest_force(degrees + 0.001), largest_force(degrees),
                0.02 * largest_force(degrees))
        << degrees;
}

}  // namespace
}  // namespace acinus::dcm
