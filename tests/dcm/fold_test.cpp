/// Two faces of an edge cannot be folded onto each other.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kLane = 2;

/// A cell at rest but for one corner of one edge, which is turned about the edge until the normals
/// of its faces are this far apart, rad; more than pi: through each other.
Cells make_folded(double theta) {
  Cells c = make_rest_cells(mesh::shared_icosphere(42), std::vector<double>(kLanes, 10));
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

TEST(Fold, ForceIsMinusEnergyGradientAndStiffnessSemiDefinite) {
  for (double degrees : {110.0, 125.0, 150.0, 165.0, 172.0, 178.0, 186.0}) {
    Cells c = make_folded(degrees * kPi / 180);
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
    std::printf("fold of %.0f degrees: force against differences %.1e of %.2g nN\n", degrees, worst,
                scale);
    EXPECT_LT(worst, 1e-6) << degrees;
    const Eigen::MatrixXd k = lane_matrices(c)[kLane];
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff()) << degrees;
  }
}

}  // namespace
}  // namespace acinus::dcm
