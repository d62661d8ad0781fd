#include "contact/jkr.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "tests/contact/reference_table.hpp"

namespace acinus::contact {
namespace {

using test::kJoulePerSquareMetre, test::kMetre, test::kNewton, test::kPascal, test::number;
using test::relative;

// Two cells of Table 1: R 12 um, E 450 Pa, nu 0.47, W 1e-5 J/m^2.
SpherePair nominal() {
  const SphereBody cell = {12.0, 0.45, 0.47};
  return reduced_pair(cell, cell, 0.01);
}

TEST(Jkr, ForceAgainstOverlapMatchesReference) {
  const auto rows = test::read_reference("jkr_F_delta.csv");
  double worst_force = 0.0, worst_radius = 0.0, worst_fold = 0.0;
  int fold_rows = 0;
  for (const auto& row : rows) {
    const SphereBody body = {number(row, 3) * kMetre, number(row, 1) * kPascal, number(row, 2)};
    const SpherePair pair = reduced_pair(body, body, number(row, 4) * kJoulePerSquareMetre);
    EXPECT_LT(relative(pair.modulus, number(row, 5) * kPascal), 1e-10);
    EXPECT_LT(relative(pair.radius, number(row, 6) * kMetre), 1e-10);
    const double overlap = number(row, 7) * kMetre;
    const double a = number(row, 8) * kMetre, force = number(row, 9) * kNewton;
    if (relative(overlap, jkr_special(pair).fold.overlap) < 1e-9) {
      // At the fold 11 printed digits of the overlap leave 5 of a: go from a to the other two.
      const JkrPoint point = jkr_at_radius(pair, a);
      worst_fold =
          std::max({worst_fold, relative(point.force, force), relative(point.overlap, overlap)});
      ++fold_rows;
      continue;
    }
    const SphereForce f = jkr_force(pair, overlap, true);
    EXPECT_TRUE(f.touching);
    worst_force = std::max(worst_force, relative(f.force, force));
    worst_radius = std::max(worst_radius, relative(f.contact_radius, a));
  }
  std::printf("jkr_F_delta: %zu rows, force %.1e radius %.1e; %d fold rows %.1e (relative)\n",
              rows.size(), worst_force, worst_radius, fold_rows, worst_fold);
  EXPECT_EQ(fold_rows, 3);
  EXPECT_LT(worst_force, 1e-8);
  EXPECT_LT(worst_radius, 1e-8);
  EXPECT_LT(worst_fold, 1e-9);
}

TEST(Jkr, CurveByContactRadiusMatchesReference) {
  const auto rows = test::read_reference("jkr_by_a.csv");
  const SpherePair pair = nominal();
  const double fold = jkr_special(pair).fold.contact_radius;
  double worst = 0.0;
  for (const auto& row : rows) {
    const double a = number(row, 1) * kMetre;
    EXPECT_LT(relative(a / fold, number(row, 0)), 1e-9);
    const JkrPoint point = jkr_at_radius(pair, a);
    // Overlap and force are differences of two terms: scale by the larger one, not by what is left.
    const double overlap_error =
        std::abs(point.overlap - number(row, 2) * kMetre) / (a * a / pair.radius);
    worst = std::max({worst, overlap_error, relative(point.force, number(row, 3) * kNewton)});
    if (number(row, 0) > 1.01) {
      const SphereForce f = jkr_force(pair, point.overlap, true);
      EXPECT_LT(relative(f.force, point.force), 1e-12);
      EXPECT_LT(relative(f.contact_radius, a), 1e-12);
    }
  }
  std::printf("jkr_by_a: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);
}

TEST(Jkr, SpecialPointsMatchReference) {
  const auto rows = test::read_reference("jkr_special.csv");
  const JkrSpecial s = jkr_special(nominal());
  const std::map<std::string, double> ours = {{"F_pulloff_load", s.pull_off.force},
                                              {"F_pulloff_disp", s.fold.force},
                                              {"a_at_Fmin", s.pull_off.contact_radius},
                                              {"a_at_dmin", s.fold.contact_radius},
                                              {"a_at_F0", s.zero_force.contact_radius},
                                              {"delta_F0", s.zero_force.overlap},
                                              {"a0^2/(3R)", s.zero_force.overlap},
                                              {"delta_min", s.fold.overlap},
                                              {"-3a_d^2/R", s.fold.overlap},
                                              {"delta_at_Fmin", s.pull_off.overlap},
                                              {"-a_F^2/3R", s.pull_off.overlap},
                                              {"F_DMT", s.dmt_force},
                                              {"F_vesicle", s.vesicle_force}};
  double worst = 0.0;
  for (const auto& row : rows) {
    ASSERT_TRUE(ours.contains(row[0])) << row[0];
    const double unit = row[0][0] == 'F' ? kNewton : kMetre;
    worst = std::max(worst, relative(ours.at(row[0]), number(row, 1) * unit));
  }
  std::printf("jkr_special: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-10);
  EXPECT_NEAR(s.zero_force.force / s.pull_off.force, 0.0, 1e-14);
  EXPECT_NEAR(s.zero_overlap.overlap / s.fold.overlap, 0.0, 1e-14);
}

TEST(Jkr, ApproachesHertzAsAdhesionVanishes) {
  const auto rows = test::read_reference("jkr_hertz_limit.csv");
  SpherePair pair = nominal();
  // The table holds one overlap, that of its Hertz force.
  const double hertz = number(rows[0], 3) * kNewton;
  const double overlap =
      std::pow(hertz / (4.0 / 3.0 * pair.modulus * std::sqrt(pair.radius)), 2.0 / 3.0);
  double worst = 0.0;
  for (const auto& row : rows) {
    pair.adhesion = number(row, 0) * kJoulePerSquareMetre;
    const SphereForce f = jkr_force(pair, overlap, false);
    // The overlap itself is known to 1e-10 only; for strong adhesion the force is a difference.
    worst = std::max({worst, std::abs(f.force - number(row, 2) * kNewton) / hertz,
                      relative(f.contact_radius, number(row, 1) * kMetre)});
  }
  std::printf("jkr_hertz_limit: %zu rows, overlap %.6f um, worst %.1e\n", rows.size(), overlap,
              worst);
  EXPECT_LT(worst, 1e-9);
}

TEST(Jkr, ZeroAndTinyAdhesionAreHertz) {
  SpherePair pair = nominal();
  for (const double adhesion : {0.0, 1e-320, 1e-300, 1e-100, 1e-40, 1e-30}) {
    pair.adhesion = adhesion;
    for (const double overlap : {1e-12, 1e-3, 1.0, 5.0}) {
      const SphereForce f = jkr_force(pair, overlap, false), h = hertz_force(pair, overlap);
      // Leading correction: 2 (W/(E a^(...)))^(1/2), below 3 sqrt(W/(E overlap^2/a)).
      const double gap =
          10.0 * std::sqrt(adhesion * h.contact_radius / pair.modulus) / overlap + 1e-14;
      EXPECT_LE(relative(f.force, h.force), gap) << adhesion << " " << overlap;
      EXPECT_LE(relative(f.stiffness, h.stiffness), gap);
    }
  }
  pair.adhesion = 0.0;
  EXPECT_TRUE(jkr_force(pair, 0.0, false).touching);
  EXPECT_EQ(jkr_force(pair, 0.0, false).force, 0.0);
  EXPECT_FALSE(jkr_force(pair, -1e-15, true).touching);
}

TEST(Jkr, ContactStartsAtZeroAndEndsBelowTheFold) {
  const SpherePair pair = nominal();
  const double fold = jkr_special(pair).fold.overlap;
  EXPECT_FALSE(jkr_force(pair, -1e-9, false).touching);
  EXPECT_TRUE(jkr_force(pair, 0.0, false).touching);
  EXPECT_TRUE(jkr_force(pair, 0.999999 * fold, true).touching);
  const SphereForce lost = jkr_force(pair, 1.000001 * fold, true);
  EXPECT_FALSE(lost.touching);
  EXPECT_EQ(lost.force, 0.0);
  EXPECT_EQ(lost.contact_radius, 0.0);
  EXPECT_EQ(lost.stiffness, 0.0);
  // First contact pulls at once: -(4/3) pi W R, which is y^3 = 4.
  EXPECT_LT(relative(jkr_force(pair, 0.0, false).force, -4.0 / 3.0 * kPi * 0.01 * 6.0), 1e-13);
}

// Every overlap from the fold to far beyond any use, five decades of adhesion and modulus.
TEST(Jkr, SolvesEverywhereOnTheStableBranch) {
  double worst = 0.0;
  for (double adhesion = 1e-8; adhesion < 2.0; adhesion *= 7.0) {
    for (double modulus = 0.05; modulus < 2e3; modulus *= 9.0) {
      const SpherePair pair = {5.3, modulus, adhesion};
      const JkrSpecial s = jkr_special(pair);
      const double depth = -s.fold.overlap;
      for (double above = 1e-15; above < 1e12; above *= 3.1) {
        const double overlap = s.fold.overlap + above * depth;
        const SphereForce f = jkr_force(pair, overlap, true);
        if (!f.touching) {
          EXPECT_LT(above, 1e-14);
          continue;
        }
        EXPECT_GE(f.contact_radius, s.fold.contact_radius * (1 - 1e-15));
        const JkrPoint point = jkr_at_radius(pair, f.contact_radius);
        // Backward error: the overlap of the answer, against the larger of its two terms.
        const double size = f.contact_radius * f.contact_radius / pair.radius;
        worst = std::max(worst, std::abs(point.overlap - overlap) / std::max(size, depth));
        const double terms = std::max(std::abs(point.force), -s.pull_off.force);
        worst = std::max(worst, std::abs(point.force - f.force) / terms);
      }
    }
  }
  std::printf("jkr sweep: worst backward error %.1e\n", worst);
  EXPECT_LT(worst, 1e-14);
}

TEST(Jkr, ForceIsEnergyGradientAndStiffnessIsForceGradient) {
  const SpherePair pair = reduced_pair({12.0, 0.45, 0.47}, {9.0, 0.6, 0.4}, 0.03);
  const JkrSpecial s = jkr_special(pair);
  const double depth = -s.fold.overlap, load = -s.pull_off.force;
  for (const double overlap :
       {-0.6 * depth, -0.3 * depth, 0.0, 0.2 * depth, 2.0 * depth, 9.0 * depth}) {
    const double h = 1e-4 * depth;  // truncation about (h/depth)^2, round-off eps depth/h
    const SphereForce f = jkr_force(pair, overlap, true);
    const SphereForce up = jkr_force(pair, overlap + h, true),
                      down = jkr_force(pair, overlap - h, true);
    const double slope =
        (jkr_energy(pair, up.contact_radius) - jkr_energy(pair, down.contact_radius)) / (2 * h);
    EXPECT_NEAR(slope, f.force, 1e-7 * load);
    EXPECT_NEAR((up.force - down.force) / (2 * h), f.stiffness, 1e-6 * load / depth);
  }
  EXPECT_EQ(jkr_energy(pair, 0.0), 0.0);
}

TEST(Jkr, ForceByModulusIsTheDerivativeAtFixedOverlap) {
  const SpherePair pair = nominal();
  const double depth = -jkr_special(pair).fold.overlap;
  for (const double overlap : {-0.5 * depth, 0.0, depth, 5.0 * depth}) {
    const double h = 1e-4 * pair.modulus;
    SpherePair stiff = pair, soft = pair;
    stiff.modulus += h;
    soft.modulus -= h;
    const double rate =
        (jkr_force(stiff, overlap, true).force - jkr_force(soft, overlap, true).force) / (2 * h);
    const double size = std::abs(jkr_special(pair).pull_off.force) / pair.modulus;
    EXPECT_NEAR(jkr_force(pair, overlap, true).force_by_modulus, rate, 1e-6 * size);
  }
}

TEST(Jkr, StiffnessIsBoundedByTheChordAtTheFold) {
  const SpherePair pair = nominal();
  const JkrSpecial s = jkr_special(pair);
  const double chord = (s.pull_off.force - s.fold.force) / (s.pull_off.overlap - s.fold.overlap);
  EXPECT_LT(relative(jkr_force(pair, s.fold.overlap, true).stiffness, chord), 1e-12);
  for (double above = 1e-12; above < 10.0; above *= 1.7) {
    const double stiffness = jkr_force(pair, s.fold.overlap * (1.0 - above), true).stiffness;
    EXPECT_TRUE(std::isfinite(stiffness));
    EXPECT_GE(stiffness, chord * (1.0 + 1e-12));
  }
  EXPECT_NEAR(jkr_force(pair, s.pull_off.overlap, true).stiffness / chord, 0.0, 1e-13);
}

TEST(Jkr, NotANumberIsPassedOn) {
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(jkr_force(nominal(), nan, true).force));
  EXPECT_TRUE(std::isnan(jkr_force(nominal(), nan, false).force));
}

TEST(Jkr, CallRate) {
  const SpherePair pair = nominal();
  const double depth = -jkr_special(pair).fold.overlap;
  std::vector<double> overlap(1024);
  for (std::size_t i = 0; i < overlap.size(); ++i) {
    overlap[i] = depth * (-0.99 + 8.0 * static_cast<double>((i * 389) % 1024) / 1024.0);
  }
  double total = 0.0, best = 1e9;
  constexpr int kRepeat = 100;
  for (int batch = 0; batch < 5; ++batch) {
    const auto start = std::chrono::steady_clock::now();
    for (int repeat = 0; repeat < kRepeat; ++repeat) {
      for (const double x : overlap) total += jkr_force(pair, x, true).force;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count());
  }
  std::printf("jkr_force: %.2f million calls/s on one core\n",
              1e-6 * kRepeat * static_cast<double>(overlap.size()) / best);
  EXPECT_TRUE(std::isfinite(total));
}

TEST(Jkr, OverlapUnderALoadIsTheInverseOfTheForce) {
  const SpherePair pair{6, 0.2888, 0.01};
  for (double overlap : {0.0, 0.376, 1.0, 4.0}) {
    const double force = jkr_force(pair, overlap, true).force;
    EXPECT_NEAR(jkr_overlap(pair, force), overlap, 1e-9);
  }
  const JkrSpecial special = jkr_special(pair);
  EXPECT_NEAR(jkr_overlap(pair, 2 * special.pull_off.force), special.pull_off.overlap, 1e-9);
}

}  // namespace
}  // namespace acinus::contact
