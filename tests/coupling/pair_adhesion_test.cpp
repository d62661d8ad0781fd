/// Adhesion between two cell types in every kind of contact of cells.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace acinus::coupling
