#include "contact/jkr_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "contact/jkr.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using reference::kEps;

/// One pair at one overlap.
struct Case {
  SpherePair pair;
  double overlap;
  bool was_touching;
};

/// All cases in lanes, eight unlike ones at a time; the last eight are filled up with the first.
std::vector<JkrLanes> forces_of(const std::vector<Case>& cases) {
  std::vector<JkrLanes> out;
  for (std::size_t first = 0; first < cases.size(); first += kLanes) {
    Lane radius, modulus, adhesion, overlap, was_touching;
    for (int l = 0; l < kLanes; ++l) {
      const Case& c = cases[(first + static_cast<std::size_t>(l)) % cases.size()];
      radius[l] = c.pair.radius;
      modulus[l] = c.pair.modulus;
      adhesion[l] = c.pair.adhesion;
      overlap[l] = c.overlap;
      was_touching[l] = c.was_touching ? 1 : 0;
    }
    out.push_back(jkr_force_lanes(radius, modulus, adhesion, overlap, was_touching));
  }
  return out;
}

/// Force, stiffness, squared radius, touching of one case.
std::array<double, 4> answer(const std::vector<JkrLanes>& lanes, std::size_t k) {
  const JkrLanes& f = lanes[k / kLanes];
  const auto l = static_cast<int>(k % kLanes);
  return {f.force[l], f.stiffness[l], f.squared_radius[l], f.touching[l]};
}

std::vector<SpherePair> wide_pairs(const std::vector<double>& adhesions) {
  std::vector<SpherePair> pairs;
  for (const double radius : {0.5, 3.0, 12.0, 50.0})
    for (const double modulus : {1e-3, 0.05, 1.0, 100.0})
      for (const double adhesion : adhesions) pairs.push_back({radius, modulus, adhesion});
  return pairs;
}
const std::vector<double> kAdhesions = {1e-6, 1e-4, 0.01, 1.0};

/// Larger of the two terms whose difference is the force, nN.
double larger_term(const SpherePair& p, double contact_radius) {
  const double a3 = contact_radius * contact_radius * contact_radius;
  return std::max(4 * p.modulus * a3 / (3 * p.radius),
                  std::sqrt(8 * kPi * p.adhesion * p.modulus * a3));
}

/// Worst differences from the scalar twin, relative to the size of each quantity.
struct Worst {
  double force = 0, squared_radius = 0, stiffness = 0;
  int n = 0;
};
Worst compare(const std::vector<Case>& cases) {
  const std::vector<JkrLanes> lanes = forces_of(cases);
  Worst worst;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& [pair, overlap, was_touching] = cases[k];
    const SphereForce twin = jkr_force(pair, overlap, was_touching);
    const auto [force, stiffness, squared_radius, touching] = answer(lanes, k);
    EXPECT_TRUE(std::isfinite(force) && std::isfinite(stiffness) && std::isfinite(squared_radius))
        << pair.radius << " " << pair.modulus << " " << pair.adhesion << " " << overlap;
    EXPECT_EQ(touching, twin.touching ? 1 : 0)
        << pair.radius << " " << pair.modulus << " " << pair.adhesion << " " << overlap;
    if (!twin.touching || touching == 0) {
      EXPECT_EQ(force, 0);
      EXPECT_EQ(stiffness, 0);
      EXPECT_EQ(squared_radius, 0);
      continue;
    }
    const double a = twin.contact_radius;
    if (a == 0) {
      EXPECT_EQ(force, 0);
      continue;
    }
    ++worst.n;
    worst.force = std::max(worst.force, std::abs(force - twin.force) / larger_term(pair, a));
    worst.squared_radius =
        std::max(worst.squared_radius, std::abs(squared_radius - a * a) / (a * a));
    // 2 E a is the stiffness without adhesion
    worst.stiffness =
        std::max(worst.stiffness, std::abs(stiffness - twin.stiffness) / (2 * pair.modulus * a));
  }
  return worst;
}

void print(const char* what, const Worst& w) {
  std::printf("%s: %d contacts, force %.1e squared radius %.1e stiffness %.1e\n", what, w.n,
              w.force, w.squared_radius, w.stiffness);
}

TEST(JkrLanes, EqualTheScalarTwinAwayFromTheFold) {
  std::vector<Case> cases;
  for (const SpherePair& pair : wide_pairs(kAdhesions)) {
    const double depth = -jkr_special(pair).fold.overlap;
    for (double above = 1e-3; above < 1e28; above *= 1.9)
      cases.push_back({pair, (above - 1) * depth, true});
    for (double share = 1e-8; share < 1; share *= 2.3)  // up to as deep as the radius
      cases.push_back({pair, share * pair.radius, true});
  }
  const Worst worst = compare(cases);
  print("jkr lanes", worst);
  EXPECT_GT(worst.n, 1000);
  EXPECT_LT(worst.force, 1e-12);
  EXPECT_LT(worst.squared_radius, 1e-12);
  EXPECT_LT(worst.stiffness, 1e-12);
}

TEST(JkrLanes, LoseOnlyTheRootOfRoundOffAtTheFold) {
  // Overlap and fold carry a few eps of round-off; above them the radius goes as the root of the
  // distance t, so that both are off by up to eps / sqrt(t), and by sqrt(eps) at the fold itself.
  for (const double above : {0.0, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    std::vector<Case> cases;
    for (const SpherePair& pair : wide_pairs(kAdhesions)) {
      const double fold = jkr_special(pair).fold.overlap;
      if (jkr_force(pair, fold * (1 - above), true).touching)
        cases.push_back({pair, fold * (1 - above), true});
    }
    const std::vector<JkrLanes> lanes = forces_of(cases);
    Worst worst;
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const SpherePair& pair = cases[k].pair;
      const SphereForce twin = jkr_force(pair, cases[k].overlap, true);
      const auto [force, stiffness, squared_radius, touching] = answer(lanes, k);
      EXPECT_TRUE(std::isfinite(force) && std::isfinite(stiffness));
      if (touching == 0) {
        EXPECT_LT(above, 1e-14);
        continue;
      }
      const double a = twin.contact_radius;
      ++worst.n;
      worst.force = std::max(worst.force, std::abs(force - twin.force) / larger_term(pair, a));
      worst.squared_radius = std::max(worst.squared_radius, std::abs(squared_radius / (a * a) - 1));
      worst.stiffness =
          std::max(worst.stiffness, std::abs(stiffness - twin.stiffness) / (2 * pair.modulus * a));
    }
    std::printf("%.0e above the fold, ", above);
    print("lanes", worst);
    const double bound = 16 * kEps / std::sqrt(std::max(above, kEps));
    EXPECT_LT(worst.force, bound);
    EXPECT_LT(worst.squared_radius, bound);
    EXPECT_LT(worst.stiffness, bound);
  }
}

TEST(JkrLanes, TouchFromZeroOverlapAndLetGoAtTheFold) {
  std::vector<Case> cases;
  for (const SpherePair& pair : wide_pairs(kAdhesions)) {
    const double depth = -jkr_special(pair).fold.overlap;
    for (const double overlap : {-1e3, -2.0, -1.001, -0.999, -0.5, -1e-9, 0.0, 1e-9, 0.5, 20.0})
      for (const bool was_touching : {true, false})
        cases.push_back({pair, overlap * depth, was_touching});
  }
  const Worst worst = compare(cases);
  EXPECT_LT(worst.force, 1e-12);
  const std::vector<JkrLanes> lanes = forces_of(cases);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const double depth = -jkr_special(cases[k].pair).fold.overlap;
    const bool expected =
        cases[k].overlap >= 0 || (cases[k].was_touching && cases[k].overlap > -depth);
    EXPECT_EQ(answer(lanes, k)[3], expected ? 1 : 0);
  }
}

TEST(JkrLanes, WithoutAdhesionAreHertz) {
  std::vector<Case> cases;
  for (const SpherePair& pair : wide_pairs({0.0}))
    for (const bool was_touching : {true, false}) {
      cases.push_back({pair, 0, was_touching});
      for (double overlap = 1e-12; overlap < 30; overlap *= 2.7)
        for (const double sign : {1.0, -1.0}) cases.push_back({pair, sign * overlap, was_touching});
    }
  const std::vector<JkrLanes> lanes = forces_of(cases);
  double worst = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const SphereForce hertz = hertz_force(cases[k].pair, cases[k].overlap);
    const auto [force, stiffness, squared_radius, touching] = answer(lanes, k);
    ASSERT_TRUE(std::isfinite(force) && std::isfinite(stiffness) && std::isfinite(squared_radius));
    if (cases[k].overlap < 0) {
      EXPECT_EQ(touching, 0) << cases[k].overlap;
    }
    if (cases[k].overlap <= 0) {
      EXPECT_NEAR(force, 0, 1e-30);
      EXPECT_NEAR(squared_radius, 0, 1e-30);
      continue;
    }
    EXPECT_EQ(touching, 1);
    const double a = hertz.contact_radius;
    worst = std::max({worst, std::abs(force / hertz.force - 1),
                      std::abs(stiffness / hertz.stiffness - 1),
                      std::abs(squared_radius / (a * a) - 1)});
  }
  std::printf("jkr lanes without adhesion: worst difference from Hertz %.1e\n", worst);
  EXPECT_LT(worst, 8 * kEps);
}

TEST(JkrLanes, DoNotDependOnTheirNeighbours) {
  const SpherePair pair = {6, 0.3, 0.01};
  const Case mine = {pair, 0.4, true};
  const auto alone = answer(forces_of(std::vector<Case>(kLanes, mine)), 0);
  for (int l = 0; l < kLanes; ++l) {
    std::vector<Case> cases;
    for (int k = 0; k < kLanes; ++k)
      cases.push_back({{0.5 + 6.0 * k, 1e-3 * std::pow(5.0, k), k % 3 == 0 ? 0.0 : 1e-3 * k},
                       k % 2 == 0 ? -1e3 : 2.0 * k,
                       k % 4 < 2});
    cases[l] = mine;
    EXPECT_EQ(answer(forces_of(cases), static_cast<std::size_t>(l)), alone) << "lane " << l;
  }
}

TEST(LaneCbrt, IsGoodToFourUnitsInTheLastPlace) {
  auto random = reference::stream(61);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    Lane v;
    for (int l = 0; l < kLanes; ++l) v[l] = std::pow(10.0, random.uniform(-300, 300));
    const Lane x = lane_cbrt(v);
    for (int l = 0; l < kLanes; ++l) {
      const double exact = static_cast<double>(std::cbrt(static_cast<long double>(v[l])));
      const double ulp = std::nextafter(exact, 2 * exact) - exact;
      worst = std::max(worst, std::abs(x[l] - exact) / ulp);
    }
  }
  std::printf("lane_cbrt: worst %.1f ulp\n", worst);
  EXPECT_LE(worst, 4);
}

// A lost number must not look like a lost contact.
TEST(JkrLanes, OverlapThatIsNoNumberGivesAForceThatIsNone) {
  const Lane one = lane_of(1), nan = lane_of(std::numeric_limits<double>::quiet_NaN());
  for (double adhesion : {0.0, 0.01}) {
    const JkrLanes law = jkr_force_lanes(one, one, lane_of(adhesion), nan, one);
    for (int l = 0; l < kLanes; ++l) {
      EXPECT_TRUE(std::isnan(law.force[l]));
      EXPECT_EQ(law.touching[l], 1);
    }
  }
}

}  // namespace
}  // namespace acinus::contact
