#include "contact/maugis_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::contact {
namespace {

/// W = 10 uJ/m^2 and h0 = 20 nm between two spheres of 10 um: lambda = 0.0045, 0.96, 4.5 and 45.
constexpr double kModuli[] = {3e4, 10.0, 1.0, 0.03};

MaugisPair pair_of(double modulus) { return {{5.0, modulus, 0.01}, 0.5}; }

double range_of(const MaugisPair& p) { return p.pair.adhesion / p.cohesive_stress; }

TEST(MaugisOverlap, GivesBackTheCurveByRadius) {
  for (const double modulus : kModuli) {
    const MaugisCurve curve = make_maugis_curve(pair_of(modulus));
    for (const double more : {1e-3, 0.03, 0.3, 1.0, 2.0}) {
      const MaugisPoint exact = maugis_at_radius(curve.pair, curve.least_radius + more);
      const MaugisPoint point = maugis_at_overlap(curve, exact.overlap);
      // Near the end of the branch the overlap hardly depends on a: half the digits, force alike.
      const double tolerance = more < 0.1 ? 1e-6 : 1e-11;
      EXPECT_NEAR(point.contact_radius, exact.contact_radius, tolerance * exact.cohesive_radius);
      EXPECT_NEAR(point.cohesive_radius, exact.cohesive_radius, tolerance * exact.cohesive_radius);
      EXPECT_NEAR(point.force, exact.force, tolerance * 4 * kPi * 5.0 * 0.01);
    }
  }
}

// Drawn apart from contact to the end there is no step, at any lambda. Where a branch ends with an
// upright tangent, c falls like the root of the way to the end.
TEST(MaugisOverlap, HasNoStepBeforeItsEnd) {
  for (const double modulus : kModuli) {
    const MaugisCurve curve = make_maugis_curve(pair_of(modulus));
    const double high = curve.contact_overlap + 0.1;
    constexpr int kSteps = 4000;
    const double step = (high - curve.least_overlap) / kSteps;
    double previous = maugis_at_overlap(curve, high).cohesive_radius;
    for (int k = 1; k < kSteps; ++k) {
      const MaugisPoint p = maugis_at_overlap(curve, high - k * step);
      EXPECT_LE(p.cohesive_radius, previous * (1 + 1e-12)) << modulus << " " << k;
      EXPECT_LT(previous - p.cohesive_radius, 8 * std::sqrt(2 * 5.0 * step)) << modulus << " " << k;
      previous = p.cohesive_radius;
    }
  }
}

TEST(MaugisOverlap, ApartTheGapAtTheRimIsTheRange) {
  const MaugisPair pair = pair_of(3e4);
  const MaugisCurve curve = make_maugis_curve(pair);
  ASSERT_EQ(curve.least_radius, 0.0);
  const MaugisPoint p = maugis_at_overlap(curve, -0.01);
  EXPECT_EQ(p.contact_radius, 0.0);
  const double c = p.cohesive_radius;
  EXPECT_NEAR(c * c / 10.0 - 4 * 0.5 * c / (kPi * 3e4) + 0.01, range_of(pair), 1e-14);
  EXPECT_NEAR(p.force, -kPi * c * c * 0.5, 1e-15);
  // DMT: spheres so stiff pull with 2 pi R sigma0 (h0 - gap).
  EXPECT_NEAR(p.force, -2 * kPi * 5.0 * 0.5 * 0.01, 2e-3 * 0.157);
}

TEST(MaugisOverlap, LeastForceIsThePullOffOfTheCurve) {
  for (const double modulus : kModuli) {
    const MaugisCurve curve = make_maugis_curve(pair_of(modulus));
    const MaugisState state = maugis_pull_off(curve.lambda);
    const double exact = state.load * kPi * 0.01 * 5.0;
    const double unit = std::cbrt(3 * kPi * 0.01 * 25.0 / (4 * modulus));
    const double there = state.approach * unit * unit / 5.0;
    // Down to the end of the curve and as far the other way; stiff spheres pull most at its end in
    // contact, where the overlap is known to the root of round-off only.
    const double way = std::max(there - curve.least_overlap, 1e-3);
    double least = 0.0;
    for (int k = 0; k <= 2000; ++k)
      least = std::min(least, maugis_at_overlap(curve, there + (k * 1e-3 - 1) * way).force);
    EXPECT_GE(least, exact * (1 + 1e-9));
    EXPECT_LE(least, exact * (1 - 1e-6));  // the steps go through the minimum
  }
}

TEST(MaugisOverlap, NothingBelowTheEndAndHertzWithoutAdhesion) {
  const MaugisCurve curve = make_maugis_curve(pair_of(10.0));
  EXPECT_EQ(maugis_at_overlap(curve, curve.least_overlap - 1e-9).force, 0.0);
  EXPECT_EQ(maugis_at_overlap(curve, curve.least_overlap - 1e-9).cohesive_radius, 0.0);
  EXPECT_LT(maugis_at_overlap(curve, curve.least_overlap + 1e-9).force, 0.0);
  const MaugisCurve bare = make_maugis_curve({{5.0, 10.0, 0.0}, 0.0});
  EXPECT_NEAR(maugis_at_overlap(bare, 0.2).force,
              4.0 / 3.0 * 10.0 * std::sqrt(5.0) * std::pow(0.2, 1.5), 1e-14);
  EXPECT_EQ(maugis_at_overlap(bare, -1e-9).force, 0.0);
}

}  // namespace
}  // namespace acinus::contact
