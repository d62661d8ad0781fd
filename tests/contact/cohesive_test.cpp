#include "contact/cohesive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace acinus::contact {
namespace {

const CohesiveLaw kLaw{0.05, 5, 0.9};

// Hand values at u = 1/2: phi = -W (1/8)(5/2), phi' = W/h 12/8, phi'' = W/h^2 12 (1/2)(-1/2) < 0.
TEST(Cohesive, HandValues) {
  EXPECT_DOUBLE_EQ(cohesive_energy(kLaw, 0.45), -0.05 * 5 / 16);
  EXPECT_DOUBLE_EQ(cohesive_traction(kLaw, 0.45), 0.05 / 0.9 * 1.5);
  EXPECT_EQ(cohesive_stiffness(kLaw, 0.45), 0);
  EXPECT_DOUBLE_EQ(cohesive_energy(kLaw, -0.1), -0.05 + 0.025);
  EXPECT_DOUBLE_EQ(cohesive_traction(kLaw, -0.1), -0.5);
  EXPECT_DOUBLE_EQ(cohesive_stiffness(kLaw, -0.1), 5);
  EXPECT_DOUBLE_EQ(cohesive_traction(kLaw, 0.3), 0.05 / 0.9 * 16 / 9);  // the peak, at u = 1/3
  EXPECT_EQ(cohesive_energy(kLaw, 0.9), 0);
  EXPECT_EQ(cohesive_traction(kLaw, 1.0), 0);
}

TEST(Cohesive, TractionIsTheSlopeOfTheEnergy) {
  const double h = 1e-5;
  for (double d = -1.5; d < 1.2; d += 0.0137) {
    const double slope = (cohesive_energy(kLaw, d + h) - cohesive_energy(kLaw, d - h)) / (2 * h);
    // h^2 phi''' / 6 with phi''' <= 48 W / h_c^3, and kEps phi / h
    EXPECT_NEAR(cohesive_traction(kLaw, d), slope, 1e-9) << d;
  }
}

TEST(Cohesive, StiffnessIsThePositivePartOfTheSecondDerivative) {
  const double h = 1e-5;
  for (double d = -1.4963; d < 1.2; d += 0.0137) {
    const double curvature =
        (cohesive_traction(kLaw, d + h) - cohesive_traction(kLaw, d - h)) / (2 * h);
    EXPECT_GE(cohesive_stiffness(kLaw, d), 0);
    EXPECT_NEAR(cohesive_stiffness(kLaw, d), std::max(0.0, curvature), 1e-6) << d;
  }
}

TEST(Cohesive, IsContinuousWithItsTraction) {
  for (double d : {0.0, kLaw.range}) {
    const double e = 1e-12;
    EXPECT_NEAR(cohesive_energy(kLaw, d - e), cohesive_energy(kLaw, d + e), 1e-11);
    EXPECT_NEAR(cohesive_traction(kLaw, d - e), cohesive_traction(kLaw, d + e), 1e-11);
  }
  EXPECT_EQ(cohesive_traction(kLaw, 0), 0);
}

TEST(Cohesive, AreaUnderTheTractionIsW) {
  const int n = 2000;
  double sum = 0;  // Simpson: exact for the cubic
  for (int k = 0; k < n; ++k) {
    const double a = kLaw.range * k / n, b = kLaw.range * (k + 1) / n;
    sum += (b - a) / 6 *
           (cohesive_traction(kLaw, a) + 4 * cohesive_traction(kLaw, (a + b) / 2) +
            cohesive_traction(kLaw, b));
  }
  std::printf("area under the traction / W - 1 = %.1e\n", sum / kLaw.adhesion - 1);
  EXPECT_NEAR(sum, kLaw.adhesion, 1e-14);
}

TEST(Cohesive, WithoutAdhesionOnlyRepels) {
  const CohesiveLaw w{0, 5, 0.9};
  for (double d = -1; d < 1; d += 0.1) {
    EXPECT_EQ(cohesive_traction(w, d), d < 0 ? 5 * d : 0);
    EXPECT_EQ(cohesive_energy(w, d), d < 0 ? 2.5 * d * d : 0);
  }
}

TEST(ContactShare, FallsSmoothlyFromOneToZero) {
  const double range = 0.3;
  EXPECT_EQ(contact_share(-1, range), 1);
  EXPECT_EQ(contact_share(0.15, range), 1);
  EXPECT_DOUBLE_EQ(contact_share(0.225, range), 0.5);
  EXPECT_EQ(contact_share(0.3, range), 0);
  EXPECT_EQ(contact_share(2, range), 0);
  double last = 1;
  for (double d = 0.15; d < 0.31; d += 1e-4) {
    const double now = contact_share(d, range);
    EXPECT_LE(now, last);
    EXPECT_LT(last - now, 1.01e-4 * 1.5 / 0.15);  // steepest slope of the smooth step
    last = now;
  }
}

}  // namespace
}  // namespace acinus::contact
