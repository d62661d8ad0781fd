#include "contact/hertz.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/vec.hpp"
#include "tests/contact/reference_table.hpp"

namespace acinus::contact {
namespace {

constexpr SphereBody kCell = {12.0, 0.45, 0.47};
constexpr double kRoundOff = 1e-14;  // a dozen operations of 1.1e-16 each

using test::relative;

TEST(Hertz, ReducedPairOfEqualCells) {
  const SpherePair pair = reduced_pair(kCell, kCell, 0.01);
  EXPECT_LT(relative(pair.radius, 6.0), kRoundOff);
  EXPECT_LT(relative(pair.modulus, 0.45 / (2.0 * (1.0 - 0.47 * 0.47))), kRoundOff);
  EXPECT_EQ(pair.adhesion, 0.01);
}

TEST(Hertz, ReducedPairOfUnlikeFlatAndRigidBodies) {
  const SphereBody other = {4.7, 0.6, 0.4};
  const SpherePair ab = reduced_pair(kCell, other, 0.0), ba = reduced_pair(other, kCell, 0.0);
  EXPECT_EQ(ab.radius, ba.radius);
  EXPECT_EQ(ab.modulus, ba.modulus);
  EXPECT_LT(relative(ab.radius, 12.0 * 4.7 / 16.7), kRoundOff);
  EXPECT_LT(relative(ab.modulus, 1.0 / ((1 - 0.47 * 0.47) / 0.45 + (1 - 0.16) / 0.6)), kRoundOff);
  const SpherePair plane = reduced_pair(kCell, {kFlat, kRigid, 0.0}, 0.0);
  EXPECT_LT(relative(plane.radius, 12.0), kRoundOff);
  EXPECT_LT(relative(plane.modulus, 0.45 / (1.0 - 0.47 * 0.47)), kRoundOff);
  const SpherePair hollow = reduced_pair(kCell, {-48.0, kRigid, 0.0}, 0.0);
  EXPECT_LT(relative(hollow.radius, 16.0), kRoundOff);
}

TEST(Hertz, HandComputedValue) {
  const SphereForce f = hertz_force({4.0, 0.75, 0.0}, 0.25);
  EXPECT_LT(relative(f.contact_radius, 1.0), kRoundOff);
  EXPECT_LT(relative(f.force, 0.25), kRoundOff);  // (4/3)(3/4) a delta
  EXPECT_LT(relative(f.stiffness, 1.5), kRoundOff);
  EXPECT_TRUE(f.touching);
}

TEST(Hertz, MatchesReferenceTable) {
  const auto rows = test::read_reference("jkr_F_delta.csv");
  int compared = 0;
  for (const auto& row : rows) {
    const SpherePair pair = {test::number(row, 6) * test::kMetre,
                             test::number(row, 5) * test::kPascal};
    const double exact = test::number(row, 9 + 1) * test::kNewton;
    const double force = hertz_force(pair, test::number(row, 7) * test::kMetre).force;
    if (exact == 0.0) {
      EXPECT_EQ(force, 0.0);
    } else {
      EXPECT_LT(relative(force, exact), 1e-9);  // 11 printed digits, overlap to the power 1.5
      ++compared;
    }
  }
  EXPECT_GE(compared, 15);
}

TEST(Hertz, ForceIsEnergyGradientAndStiffnessIsForceGradient) {
  const SpherePair pair = reduced_pair(kCell, {9.0, 0.5, 0.4}, 0.0);
  for (const double overlap : {1e-3, 0.1, 1.0, 4.0}) {
    // Central differences of x^2.5 and x^1.5: relative error (h/x)^2 plus round-off eps x/h.
    const double h = 1e-4 * overlap;
    const SphereForce f = hertz_force(pair, overlap);
    const double slope =
        (hertz_energy(pair, overlap + h) - hertz_energy(pair, overlap - h)) / (2 * h);
    EXPECT_LT(relative(slope, f.force), 2e-8);
    const double rate =
        (hertz_force(pair, overlap + h).force - hertz_force(pair, overlap - h).force) / (2 * h);
    EXPECT_LT(relative(rate, f.stiffness), 2e-8);
    EXPECT_LT(relative(f.force_by_modulus * pair.modulus, f.force), kRoundOff);
  }
}

TEST(Hertz, NothingBeforeTouching) {
  const SphereForce apart = hertz_force({6.0, 0.3}, -1e-9);
  EXPECT_FALSE(apart.touching);
  EXPECT_EQ(apart.force, 0.0);
  const SphereForce just = hertz_force({6.0, 0.3}, 0.0);
  EXPECT_TRUE(just.touching);
  EXPECT_EQ(just.force, 0.0);
  EXPECT_EQ(hertz_energy({6.0, 0.3}, -1.0), 0.0);
  EXPECT_TRUE(std::isnan(hertz_force({6.0, 0.3}, std::nan("")).force));
}

TEST(MirrorWall, EqualsTheForceOfTheImageCell) {
  for (const double height : {11.99, 11.5, 10.0, 7.0}) {
    const SphereForce wall = mirror_wall_force(kCell, height);
    const SphereForce image = hertz_force(reduced_pair(kCell, kCell, 0.0), 24.0 - 2.0 * height);
    EXPECT_LT(relative(wall.force, image.force), 1e-13);  // both overlaps lose digits at 11.99
    EXPECT_LT(relative(wall.contact_radius, image.contact_radius), 1e-13);
    // The image moves too: moving the cell by dh changes the distance by 2 dh.
    EXPECT_LT(relative(wall.stiffness, 2.0 * image.stiffness), 1e-13);
    EXPECT_LT(relative(mirror_wall_compression(12.0, height), 1.0 - 2.0 * height / 24.0), 1e-13);
  }
  EXPECT_FALSE(mirror_wall_force(kCell, 12.5).touching);
  EXPECT_EQ(mirror_wall_compression(12.0, 12.5), 0.0);
}

// Exact Hertz contact of principal curvatures 1/R' > 1/R'': the ratio b/a of the ellipse by
// bisection.
struct Ellipse {
  double force, area, overlap;
};
Ellipse exact_ellipse(double across, double along, double modulus) {
  const double a_curvature = 0.5 / along, b_curvature = 0.5 / across;
  const auto integrals = [](double k) {
    const double modulus_k = std::sqrt(1.0 - k * k);
    return std::pair(std::comp_ellint_1(modulus_k), std::comp_ellint_2(modulus_k));
  };
  double low = 1e-3, high = 1.0 - 1e-6;
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    const auto [first, second] = integrals(k);
    const double ratio = (second / (k * k) - first) / (first - second);
    (ratio > b_curvature / a_curvature ? low : high) = k;
  }
  const auto [first, second] = integrals(low);
  const double a =
      low / ((1.0 - low * low) * a_curvature) * (first - second) / modulus;  // p0 = 1 kPa
  const double b = low * a;
  return {2.0 / 3.0 * kPi * a * b, kPi * a * b, b * first / modulus};
}

TEST(VesselPair, CircleReplacesTheEllipseWithinTheStatedError) {
  const SphereBody vessel = {4.7, 0.6, 0.4};
  const SpherePair pair = vessel_pair(kCell, vessel, 0.0);
  const double across = 12.0 * 4.7 / 16.7;
  EXPECT_LT(relative(pair.radius, std::sqrt(across * 12.0)), kRoundOff);
  EXPECT_LT(relative(pair.modulus, reduced_pair(kCell, vessel, 0.0).modulus), kRoundOff);
  const Ellipse exact = exact_ellipse(across, 12.0, pair.modulus);
  const SphereForce circle = hertz_force(pair, exact.overlap);
  const double area = kPi * circle.contact_radius * circle.contact_radius;
  std::printf("vessel as circle / exact ellipse: force %.4f area %.4f\n",
              circle.force / exact.force, area / exact.area);
  EXPECT_NEAR(circle.force / exact.force, 0.9678, 1e-4);
  EXPECT_NEAR(area / exact.area, 1.0212, 1e-4);
}

TEST(VesselPair, WideVesselIsAPlane) {
  const SpherePair wide = vessel_pair(kCell, {1e9, kRigid, 0.0}, 0.02);
  const SpherePair plane = reduced_pair(kCell, {kFlat, kRigid, 0.0}, 0.02);
  EXPECT_LT(relative(wide.radius, plane.radius), 1e-8);  // R/r = 1.2e-8, halved by the root
  EXPECT_EQ(wide.modulus, plane.modulus);
  EXPECT_EQ(wide.adhesion, 0.02);
}

}  // namespace
}  // namespace acinus::contact
