/// Tests that the fit finds known laws, from clumps of spheres whose force they made.

#include "calibration/fit_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/jkr.hpp"
#include "core/error.hpp"

namespace acinus::calibration {
namespace {

cbm::Params sphere() {
  cbm::Params p;
  p.young = 0.45;
  p.poisson = 0.47;
  p.adhesion = 0.01;
  return p;
}

/// Body-centred lattice so large that the neighbours of the middle cell have all of theirs,
/// shrunk so that neighbours overlap by d.
ClumpSnapshot lattice(double d) {
  ClumpSnapshot m;
  const double edge = 24 * (1 - d) * 2 / std::sqrt(3.0);
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z) {
        const Vec3 place = 0.5 * edge * Vec3(x, y, z);
        const bool corner = x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
        const bool middle = x % 2 != 0 && y % 2 != 0 && z % 2 != 0;
        if ((corner || middle) && place.norm() < 2.01 * edge) m.center.push_back(place);
      }
  m.radius.assign(m.center.size(), 12.0);
  return m;
}

std::size_t middle_of(const ClumpSnapshot& m) {
  for (std::size_t i = 0; i < m.center.size(); ++i)
    if (m.center[i].norm() < 1e-9) return i;
  return m.center.size();
}

/// Compression whose force is that of spheres of this law, and of which the middle cell counts.
Compression compression_with(const cbm::StiffnessLaw& law, double young) {
  cbm::Params p = sphere();
  p.young = young;
  p.correction = law;
  Compression compression;
  compression.inner = {middle_of(lattice(0))};
  for (int k = 0; k <= 40; ++k)
    compression.snapshots.push_back(as_spheres(lattice(0.03 + 0.005 * k), p, compression.inner));
  return compression;
}

TEST(Fit, SpheresInPlaceFeelTheLawOfTheirOwnOverlap) {
  Compression compression;
  compression.inner = {middle_of(lattice(0.1))};
  const Bulk plain = bulk_as_spheres(lattice(0.1), sphere(), compression.inner);
  EXPECT_NEAR(plain.overlap, 8 * 0.1 / 12, 1e-12);  // next neighbours are 0.04 diameters apart
  cbm::Params stiff = sphere();
  stiff.correction = {{{4000, 4}}, {}, 0.2};
  EXPECT_GT(bulk_as_spheres(lattice(0.1), stiff, compression.inner).force, 1.05 * plain.force);
}

TEST(Fit, InnerSpheresFollowTheirOwnOverlapOthersTheMean) {
  ClumpSnapshot snapshot = lattice(0.1);
  const std::size_t middle = middle_of(snapshot);
  std::size_t near = middle;
  for (std::size_t i = 0; i < snapshot.center.size(); ++i)
    if (std::abs(snapshot.center[i].norm() - 24 * 0.9) < 1e-9) near = i;
  snapshot.center[near] *= 0.97;  // both have a d of their own now
  cbm::Params law = sphere();
  law.correction = {{{4000, 4}}, {}, 0.3};
  const std::vector<std::size_t> inner{middle, near};
  const ClumpSnapshot spheres = as_spheres(snapshot, law, inner);
  const auto modulus = [&](const std::vector<std::size_t>& cells) {
    ClumpSnapshot m = snapshot;
    m.force.assign(m.center.size(), 0.0);
    return cbm::corrected_modulus(law.correction, 0.45, measure_bulk(m, cells).overlap).value;
  };
  double expected = 0;
  for (std::size_t j = 0; j < snapshot.center.size(); ++j) {
    const double apart = (snapshot.center[middle] - snapshot.center[j]).norm();
    if (j == middle || apart > 24) continue;
    expected +=
        contact::jkr_force(
            contact::reduced_pair({12, modulus({middle}), 0.47},
                                  {12, modulus(j == near ? std::vector{near} : inner), 0.47}, 0.01),
            24 - apart, true)
            .force;
  }
  EXPECT_NE(modulus({near}), modulus({middle}));
  EXPECT_NEAR(spheres.force[middle], expected, 1e-9 * expected);
}

TEST(Fit, FindsTheFactorOfAKnownLaw) {
  const auto found = fit_law(compression_with({{{4000, 4}}, {}, 0.3}, 0.45), sphere(), {});
  ASSERT_EQ(found.size(), 1u);  // one term is enough
  EXPECT_NEAR(found[0].law.a1, 4000, 40);
  EXPECT_LT(found[0].law.rms_relative, 0.005);
  EXPECT_LE(found[0].law.a1_interval[0], found[0].law.a1);
  EXPECT_GE(found[0].law.a1_interval[1], found[0].law.a1);
  EXPECT_GT(found[0].law.overlap_range[1], 0.15);
  EXPECT_LE(found[0].law.overlap_range[1], 0.2);
  EXPECT_GT(found[0].law.jkr_underestimation, 3);
}

TEST(Fit, FindsThePowerWhenAsked) {
  FitOptions options;
  options.free_power = true;
  const auto power = fit_law(compression_with({{{1000, 3}}, {}, 0.3}, 0.45), sphere(), options);
  EXPECT_NEAR(power[0].law.power, 3, 0.05);
  EXPECT_NEAR(power[0].law.a1, 1000, 100);
}

TEST(Fit, MakesATableWhereOneTermIsNotEnough) {
  // Soft until the cells fill the available volume, then hard: what no power of d follows.
  const cbm::StiffnessLaw wanted{{}, {{0.05, 0}, {0.09, 0.1}, {0.11, 5}, {0.3, 6}}, 0.3};
  const auto found = fit_law(compression_with(wanted, 0.1), sphere(), {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_GT(found[0].law.rms_relative, 0.1);
  EXPECT_LT(found[1].law.rms_relative, 0.05);
  EXPECT_EQ(found[1].law.a1, found[0].law.a1);
  EXPECT_NEAR(found[1].law.a0, 0.1, 0.02);
  const cbm::StiffnessLaw law = stiffness_law(found[1].law);
  double last = 0;
  for (double d = 0; d < 0.3; d += 0.001) {
    const double e = cbm::corrected_modulus(law, found[1].law.a0, d).value;
    EXPECT_GE(e, last) << d;
    last = e;
  }
  for (const double d : {0.08, 0.12, 0.16}) {
    const double e = cbm::corrected_modulus(wanted, 0.1, d).value;
    EXPECT_NEAR(cbm::corrected_modulus(law, found[1].law.a0, d).value, e, 0.2 * e) << d;
  }
}

TEST(Fit, BeginsATableWithTheModulusAtWhichTwoSpheresRestAsTwoCells) {
  const cbm::StiffnessLaw wanted{{}, {{0.05, 0}, {0.09, 0.1}, {0.11, 5}, {0.3, 6}}, 0.3};
  Compression compression = compression_with(wanted, 0.1);
  const Law without = fit_law(compression, sphere(), {}).back().law;
  for (const double overlap : {0.1, 0.15, 0.2}) {
    compression.pair_overlap = overlap;
    const Law law = fit_law(compression, sphere(), {}).back().law;
    ASSERT_EQ(law.table.size(), without.table.size() + 1) << overlap;
    EXPECT_DOUBLE_EQ(law.table[0].overlap, overlap / 12);
    EXPECT_EQ(law.a0, law.table[0].modulus);
    EXPECT_LT(law.a0, law.table[1].modulus);
    EXPECT_EQ(law.overlap_range, without.overlap_range) << "that of the clump";
    EXPECT_NEAR(law.rms_relative, without.rms_relative, 1e-3) << "the clump's fit stays";
    // Two spheres with the law rest there, and any nearer or farther they push or pull.
    const auto force = [&](double d) {
      const double young = cbm::corrected_modulus(stiffness_law(law), law.a0, d / 12).value;
      const contact::SphereBody body{12, young, 0.47};
      return contact::jkr_force(contact::reduced_pair(body, body, 0.01), 24 * d, true).force;
    };
    EXPECT_NEAR(force(overlap), 0, 1e-9);
    EXPECT_GT(force(1.05 * overlap), 0);
    EXPECT_LT(force(0.95 * overlap), 0);
  }
}

TEST(Fit, LeavesAPairOutThatIsNoSofterThanTheClumpOrDoesNotAdhere) {
  const cbm::StiffnessLaw wanted{{}, {{0.05, 0}, {0.09, 0.1}, {0.11, 5}, {0.3, 6}}, 0.3};
  Compression compression = compression_with(wanted, 0.1);
  const Law without = fit_law(compression, sphere(), {}).back().law;
  const auto table_of = [&](double overlap, double adhesion) {
    compression.pair_overlap = overlap;
    cbm::Params p = sphere();
    p.adhesion = adhesion;
    return fit_law(compression, p, {}).back().law.table;
  };
  EXPECT_EQ(table_of(0.01, 0.01).size(), without.table.size()) << "stiffer than the clump";
  EXPECT_EQ(table_of(0.9, 0.01).size(), without.table.size()) << "beyond the first overlap";
  EXPECT_EQ(table_of(0.15, 0).size(), table_of(0, 0).size());
}

TEST(Fit, MakesNoTableOfACompressionThatEndsWhereItPressesLeast) {
  const cbm::StiffnessLaw wanted{{}, {{0.05, 0}, {0.09, 0.1}, {0.11, 5}, {0.3, 6}}, 0.3};
  for (const double end : {0.03, 0.3}) {  // apart, or deeper than what counts
    Compression compression = compression_with(wanted, 0.1);
    compression.snapshots.push_back(lattice(end));
    compression.snapshots.back().force.assign(compression.snapshots[0].center.size(), -100);
    EXPECT_EQ(fit_law(compression, sphere(), {}).size(), 1u);
  }
}

TEST(Fit, RefusesWhatIsNoCompressionOrNeedsNoCorrection) {
  EXPECT_THROW(fit_law({}, sphere(), {}), Error);
  EXPECT_THROW(fit_law(compression_with({}, 0.1), sphere(), {}), Error);
}

}  // namespace
}  // namespace acinus::calibration
