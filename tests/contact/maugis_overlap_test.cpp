#include "contact/maugis_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"
#include "tests/contact/maugis_spheres.hpp"

namespace acinus::contact {
namespace {

using test::kModuli, test::pair_of;

double range_of(const MaugisPair& p) { return p.pair.adhesion / p.cohesive_stress; }

TEST(MaugisOverlap, GivesBackTheCurveByRadius) {
  for (const double modulus : kModuli) {
    const MaugisPair pair = pair_of(modulus);
    for (const double more : {1e-3, 0.03, 0.3, 1.0, 2.0}) {
      const MaugisPoint exact = maugis_at_radius(pair, maugis_turning_radius(pair) + more);
      const MaugisPoint point = maugis_at_overlap(pair, exact.overlap);
      // Near the end of the branch the overlap hardly depends on a: half the digits, force alike.
      const double tolerance = more < 0.1 ? 1e-6 : 1e-11;
      EXPECT_NEAR(point.contact_radius, exact.contact_radius, tolerance * exact.cohesive_radius);
      EXPECT_NEAR(point.cohesive_radius, exact.cohesive_radius, tolerance * exact.cohesive_radius);
      const double size = std::abs(exact.force) + 4 * kPi * 5.0 * 0.01;
      EXPECT_NEAR(point.force, exact.force, tolerance * size);
    }
  }
}

// Drawn apart from contact to the end there is no step, at any lambda. Where a branch ends with an
// upright tangent, c falls like the root of the way to the end.
TEST(MaugisOverlap, HasNoStepBeforeItsEnd) {
  for (const double modulus : kModuli) {
    const MaugisPair pair = pair_of(modulus);
    const double low = least_overlap(pair);
    const double high = maugis_at_radius(pair, maugis_turning_radius(pair)).overlap + 0.1;
    constexpr int kSteps = 4000;
    const double step = (high - low) / kSteps;
    double previous = maugis_at_overlap(pair, high).cohesive_radius;
    for (int k = 1; k < kSteps; ++k) {
      const MaugisPoint p = maugis_at_overlap(pair, high - k * step);
      EXPECT_LE(p.cohesive_radius, previous * (1 + 1e-12)) << modulus << " " << k;
      EXPECT_LT(previous - p.cohesive_radius, 8 * std::sqrt(2 * 5.0 * step)) << modulus << " " << k;
      previous = p.cohesive_radius;
    }
  }
}

TEST(MaugisOverlap, ApartTheGapAtTheRimIsTheRange) {
  const MaugisPair pair = pair_of(3e4);
  ASSERT_EQ(maugis_turning_radius(pair), 0.0);
  const MaugisPoint p = maugis_at_overlap(pair, -0.01);
  EXPECT_EQ(p.contact_radius, 0.0);
  const double c = p.cohesive_radius;
  EXPECT_NEAR(c * c / 10.0 - 4 * 0.5 * c / (kPi * 3e4) + 0.01, range_of(pair), 1e-14);
  EXPECT_NEAR(p.force, -kPi * c * c * 0.5, 1e-15);
  // DMT: spheres so stiff pull with 2 pi R sigma0 (h0 - gap).
  EXPECT_NEAR(p.force, -2 * kPi * 5.0 * 0.5 * 0.01, 2e-3 * 0.157);
}

TEST(MaugisOverlap, LeastForceIsThePullOffOfTheCurve) {
  for (const double modulus : kModuli) {
    const MaugisPair pair = pair_of(modulus);
    const MaugisState state = maugis_pull_off(maugis_lambda(pair));
    const double exact = state.load * kPi * 0.01 * 5.0;
    const double unit = std::cbrt(3 * kPi * 0.01 * 25.0 / (4 * modulus));
    const double there = state.approach * unit * unit / 5.0;
    // Down to the end of the curve and as far the other way; stiff spheres pull most at its end in
    // contact, where the overlap is known to the root of round-off only.
    const double way = std::max(there - least_overlap(pair), 1e-3);
    double least = 0.0;
    for (int k = 0; k <= 2000; ++k)
      least = std::min(least, maugis_at_overlap(pair, there + (k * 1e-3 - 1) * way).force);
    EXPECT_GE(least, exact * (1 + 1e-9));
    EXPECT_LE(least, exact * (1 - 1e-6));  // the steps go through the minimum
  }
}

TEST(MaugisOverlap, NothingBelowTheEndAndHertzWithoutAdhesion) {
  const MaugisPair pair = pair_of(10.0);
  const double end = least_overlap(pair);
  EXPECT_EQ(maugis_at_overlap(pair, end - 1e-9).force, 0.0);
  EXPECT_EQ(maugis_at_overlap(pair, end - 1e-9).cohesive_radius, 0.0);
  EXPECT_LT(maugis_at_overlap(pair, end + 1e-9).force, 0.0);
  const MaugisPair bare = {{5.0, 10.0, 0.0}, 0.0};
  EXPECT_NEAR(maugis_at_overlap(bare, 0.2).force,
              4.0 / 3.0 * 10.0 * std::sqrt(5.0) * std::pow(0.2, 1.5), 1e-14);
  EXPECT_EQ(maugis_at_overlap(bare, -1e-9).force, 0.0);
}

}  // namespace
}  // namespace acinus::contact
