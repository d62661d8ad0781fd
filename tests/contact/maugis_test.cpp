#include "contact/maugis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/jkr.hpp"
#include "core/vec.hpp"
#include "tests/contact/reference_table.hpp"

namespace acinus::contact {
namespace {

using test::kMetre, test::kPascal, test::number, test::relative;

constexpr SpherePair kPair = {6.0, 0.288794763, 0.01};

TEST(Maugis, ClosureAtLambdaOneAndRadiusOne) {
  const MaugisState state = maugis_state(1.0, 1.0);
  EXPECT_NEAR(state.c, 1.41596178, 5e-9);  // 8 decimals are known
}

TEST(Maugis, PullOffMatchesReference) {
  const auto rows = test::read_reference("maugis_pulloff.csv");
  double worst_load = 0.0, worst_a = 0.0, worst_m = 0.0;
  for (const auto& row : rows) {
    const MaugisState state = maugis_pull_off(number(row, 0));
    worst_load = std::max(worst_load, relative(state.load, number(row, 1)));
    EXPECT_LT(relative(state.load / -1.5, number(row, 2)), 1e-9);
    EXPECT_LT(relative(state.load / -2.0, number(row, 3)), 1e-9);
    worst_a = std::max(worst_a, relative(state.a, number(row, 4)));
    worst_m = std::max(worst_m, relative(state.c / state.a, number(row, 5)));
  }
  std::printf("maugis_pulloff: %zu rows, load %.1e, A %.1e, m %.1e\n", rows.size(), worst_load,
              worst_a, worst_m);
  EXPECT_LT(worst_load, 1e-9);
  // A minimum fixes its place to the root of the precision of its value only.
  EXPECT_LT(worst_a, 1e-4);
  EXPECT_LT(worst_m, 1e-4);
}

TEST(Maugis, StressProfileMatchesReference) {
  const auto rows = test::read_reference("maugis_stress_profile.csv");
  double worst = 0.0;
  for (const auto& row : rows) {
    const double r = number(row, 0) * kMetre;
    worst = std::max(
        worst, std::abs(maugis_adhesive_pressure(0.5, 1.0, 1.3, r) - number(row, 1) * kPascal));
    worst = std::max(worst, std::abs(hertz_pressure(kPair, 1.0, r) - number(row, 2) * kPascal));
  }
  std::printf("maugis_stress_profile: %zu rows, worst %.1e kPa\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);  // of 0.5 kPa
  EXPECT_EQ(maugis_adhesive_pressure(0.5, 1.0, 1.3, 1.31), 0.0);
}

// Both laws differ in sigma0 only, so this checks reduced units and formulas against other code.
TEST(Maugis, ApproachesJkrForLargeLambda) {
  const MaugisPair pair = {kPair, 400.0};
  ASSERT_GT(maugis_lambda(pair), 1e3);
  const double load = kPi * kPair.adhesion * kPair.radius;
  for (const double a : {1.0, 1.6, 2.0, 3.0}) {
    const MaugisPoint point = maugis_at_radius(pair, a);
    const JkrPoint exact = jkr_at_radius(kPair, a);
    EXPECT_NEAR(point.force, exact.force,
                10.0 / maugis_lambda(pair) * load);  // first order in 1/lambda
    EXPECT_NEAR(point.overlap, exact.overlap, 10.0 / maugis_lambda(pair) * a * a / kPair.radius);
  }
  EXPECT_NEAR(maugis_pull_off(1e4).load, -1.5, 1e-6);
}

TEST(Maugis, ApproachesDmtForSmallLambda) {
  EXPECT_NEAR(maugis_pull_off(1e-5).load, -2.0, 1e-5);
  // DMT: the Hertz load shifted by -2 pi W R.
  EXPECT_NEAR(maugis_state(1e-6, 1.0).load, 1.0 - 2.0, 1e-2);
}

TEST(Maugis, RingAloneAtZeroRadius) {
  const double lambda = 0.3;
  const MaugisState state = maugis_state(lambda, 0.0);
  const double c = state.c;
  const double closure = kPi / 4 * lambda * c * c + 4.0 / 3.0 * lambda * lambda * c * (kPi / 2 - 1);
  EXPECT_NEAR(closure, 1.0, 1e-14);
  EXPECT_NEAR(state.load, -kPi / 2 * lambda * c * c, 1e-14);
  const MaugisState close = maugis_state(lambda, 1e-7);
  EXPECT_NEAR(close.load, state.load, 1e-6);
  EXPECT_NEAR(close.approach, state.approach, 1e-6);
}

TEST(Maugis, PressureIntegratesToTheForce) {
  const MaugisPair pair = {kPair, 0.05};
  const double a = 1.8;
  const MaugisPoint point = maugis_at_radius(pair, a);
  // Inside, r = a sin t removes the square-root ends: the rule converges like n^-2 from the arccos
  // at t = pi/2.
  constexpr int kPoints = 20000;
  double inner = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double t = (i + 0.5) * 0.5 * kPi / kPoints;
    const double r = a * std::sin(t);
    const double pressure =
        hertz_pressure(kPair, a, r) +
        maugis_adhesive_pressure(pair.cohesive_stress, a, point.cohesive_radius, r);
    inner += pressure * 2.0 * kPi * r * a * std::cos(t) * 0.5 * kPi / kPoints;
  }
  const double c = point.cohesive_radius;
  const double ring = -pair.cohesive_stress * kPi * (c * c - a * a);
  EXPECT_LT(relative(inner + ring, point.force), 1e-6);
  const double overlap =
      a * a / kPair.radius - 2.0 * pair.cohesive_stress / kPair.modulus * std::sqrt(c * c - a * a);
  EXPECT_LT(relative(point.overlap, overlap), 1e-12);
}

TEST(Maugis, PullOffIsTheLeastLoad) {
  for (const double lambda : {0.01, 0.22, 1.0, 5.0, 50.0}) {
    const MaugisState least = maugis_pull_off(lambda);
    for (double a = 0.0; a < 2.0; a += 0.01) {
      EXPECT_GE(maugis_state(lambda, a).load, least.load - 1e-12);
    }
  }
}

}  // namespace
}  // namespace acinus::contact
