/// Adhesion between two cell types in every kind of contact of cells.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "contact/jkr.hpp"
#include "coupling/measure/measure.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kOwn = 0.01, kOther = 0.004;  // nN/um

World make_pair(bool first, bool second, double distance, dcm::ContactLaw law) {
  World w = make_test_world({{Vec3::Zero(), first}, {Vec3(distance, 0.3, 0.2), second}});
  w.params.dcm_contact.law = law;
  return w;
}

/// Normal force of the pair, nN, with these adhesions of the only type.
double force_with(World w, double adhesion, const std::vector<double>& with) {
  w.params.dcm[0].adhesion = w.params.cbm[0].adhesion = adhesion;
  w.params.dcm[0].adhesion_with = w.params.cbm[0].adhesion_with = with;
  const Observed o(std::move(w));
  return measure_cells(o.world, o.work)[0].normal_force;
}

TEST(PairAdhesion, ActsInEveryKindOfContactAsThatOfATypeDoes) {
  for (const dcm::ContactLaw law : {dcm::ContactLaw::kCohesive, dcm::ContactLaw::kMaugisDugdale})
    for (const auto& [first, second] :
         {std::pair(true, true), std::pair(true, false), std::pair(false, false)}) {
      const World w = make_pair(first, second, 23.4, law);
      const double own = force_with(w, kOwn, {}), other = force_with(w, kOther, {});
      EXPECT_GT(other, own) << "less adhesion, more repulsion";
      EXPECT_NEAR(force_with(w, kOwn, {kOther}), other, 1e-12 * std::abs(other))
          << first << second << static_cast<int>(law);
    }
}

TEST(PairAdhesion, FindsContactsAsFarAsItReaches) {
  for (const auto& [first, second] :
       {std::pair(true, true), std::pair(true, false), std::pair(false, false)}) {
    const World w = make_pair(first, second, 23.4, dcm::ContactLaw::kMaugisDugdale);
    EXPECT_NEAR(force_with(w, 0, {kOwn}), force_with(w, kOwn, {}), 1e-12) << first << second;
  }
}

/// Normal force of the pair, nN, whose cells have these factors on their adhesion.
double force_of_factors(World w, double of_first, double of_second) {
  w.state.adhesion.assign(w.state.dcm.n_lane() + w.state.cbm.n_cell(), 1.0);
  for_each_cell(w.state, [&](const Cell& c) {
    w.state.adhesion[c.index] = lineage_of(w.state, c) == 0 ? of_first : of_second;
  });
  const Observed o(std::move(w));
  const std::vector<CellMeasure> cells = measure_cells(o.world, o.work);
  EXPECT_NEAR(cells[0].normal_force, cells[1].normal_force, 1e-12);
  return cells[0].normal_force;
}

TEST(PairAdhesion, FactorsOfCellsAreThatOfTheirGeometricMean) {
  for (const dcm::ContactLaw law : {dcm::ContactLaw::kCohesive, dcm::ContactLaw::kMaugisDugdale})
    for (const auto& [first, second] : {std::pair(true, true), std::pair(true, false),
                                        std::pair(false, true), std::pair(false, false)}) {
      const World w = make_pair(first, second, 23.4, law);
      const double whole = force_with(w, kOwn, {}), less = force_with(w, 0.3 * kOwn, {}),
                   none = force_with(w, 0, {});
      EXPECT_GT(less, whole);
      for (const auto& [f, g] : {std::pair(0.1, 0.9), std::pair(0.9, 0.1), std::pair(0.3, 0.3)})
        EXPECT_NEAR(force_of_factors(w, f, g), less, 1e-10 * std::abs(less))
            << f << first << second;
      EXPECT_NEAR(force_of_factors(w, 1, 1), whole, 1e-12 * std::abs(whole));
      for (const double least : {0.0, 1e-300, 1e-30, 1e-12})
        EXPECT_NEAR(force_of_factors(w, least, least), none, 1e-8 * std::abs(none)) << least;
    }
}

TEST(PairAdhesion, ForceIsMinusTheGradientOfTheEnergyWithAFactor) {
  const auto pair_of = [](const World& w, double factor) {
    const contact::SphereBody body{12, w.state.cbm.young[0], w.params.cbm[0].poisson};
    return contact::reduced_pair(body, body, factor * kOwn);
  };
  const auto world_at = [](double overlap) {
    return make_test_world({{Vec3::Zero(), false}, {Vec3(24 - overlap, 0, 0), false}});
  };
  constexpr double kOverlap = 0.6, kShift = 1e-4, kFactor = 0.42;
  const double force = force_of_factors(world_at(kOverlap), 0.7, kFactor * kFactor / 0.7);
  const contact::SpherePair pair = pair_of(world_at(kOverlap), kFactor);
  const auto energy = [&](double overlap) {
    double low = 0, high = 6;  // the contact radius of an overlap, on the stable branch
    low = contact::jkr_special(pair).fold.contact_radius;
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      (contact::jkr_at_radius(pair, middle).overlap < overlap ? low : high) = middle;
    }
    return contact::jkr_energy(pair, low);
  };
  const double slope = (energy(kOverlap + kShift) - energy(kOverlap - kShift)) / (2 * kShift);
  EXPECT_NEAR(force, slope, 1e-6 * std::abs(force));
}

}  // namespace
}  // namespace acinus::coupling
