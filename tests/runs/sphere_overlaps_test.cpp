/// Advice on overlaps of spheres.

#include "runs/session/sphere_overlaps.hpp"

#include <gtest/gtest.h>

#include "tests/coupling/worlds.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

coupling::World spheres() {
  return coupling::make_test_world({{Vec3(-11, 0, 0), false}, {Vec3(11, 0, 0), false}});
}

RunTotals totals(double pair, double vessel) {
  RunTotals t;
  t.max_overlap_cbm_um = pair;
  t.cbm_vessel_um = vessel;
  return t;
}

constexpr const char* kConsequence = "where spheres overlap this deeply";

TEST(SphereOverlaps, HaveAConsequenceBeyondHalfAndFourTenthsOfARadius) {
  const coupling::World w = spheres();
  EXPECT_EQ(advise_sphere_overlaps(w, totals(5.9, 4.7)), "");
  EXPECT_CONTAINS(advise_sphere_overlaps(w, totals(6.2, 4.7)), kConsequence);
  EXPECT_CONTAINS(advise_sphere_overlaps(w, totals(5.9, 4.9)), kConsequence);
  EXPECT_CONTAINS(advise_sphere_overlaps(w, totals(6.2, 4.9)), "stiffness_correction");
}

TEST(SphereOverlaps, AdviseALawOnlyToPlainSpheres) {
  coupling::World w = spheres();
  w.params.cbm[0].correction.term.push_back({4e3, 4});
  const std::string text = advise_sphere_overlaps(w, totals(0, 5));
  EXPECT_CONTAINS(text, kConsequence);
  EXPECT_EQ(text.find("stiffness_correction"), std::string::npos);
}

TEST(SphereOverlaps, OfSistersAreNoFaultAndDeformableCellsHaveNone) {
  coupling::World w = spheres();
  w.state.divisions = 1;
  EXPECT_EQ(advise_sphere_overlaps(w, totals(17, 0)), "");
  const coupling::World deformable = coupling::make_test_world({{Vec3::Zero(), true}});
  EXPECT_EQ(advise_sphere_overlaps(deformable, totals(17, 17)), "");
}

}  // namespace
}  // namespace acinus::runs
