/// Overlaps of spheres that a run reports in words.

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

TEST(SphereOverlaps, AreReportedBeyondHalfAndAQuarterOfARadius) {
  const coupling::World w = spheres();
  EXPECT_EQ(describe_sphere_overlaps(w, totals(5.9, 2.9)), "");
  const std::string pair = describe_sphere_overlaps(w, totals(6.2, 2.9));
  EXPECT_CONTAINS(pair, "spheres of radius 12 um overlap by up to 6.2 um: ");
  EXPECT_CONTAINS(pair, "stiffness_correction");
  EXPECT_CONTAINS(describe_sphere_overlaps(w, totals(6.2, 3.3)),
                  "overlap by up to 6.2 um and reach up to 3.3 um into vessels: ");
}

TEST(SphereOverlaps, AdviseALawOnlyToPlainSpheres) {
  coupling::World w = spheres();
  w.params.cbm[0].correction.term.push_back({4e3, 4});
  const std::string text = describe_sphere_overlaps(w, totals(0, 4));
  EXPECT_CONTAINS(text, "reach up to 4 um into vessels");
  EXPECT_EQ(text.find("stiffness_correction"), std::string::npos);
}

TEST(SphereOverlaps, OfSistersAreNoFaultAndDeformableCellsHaveNone) {
  coupling::World w = spheres();
  w.state.divisions = 1;
  EXPECT_EQ(describe_sphere_overlaps(w, totals(17, 0)), "");
  const coupling::World deformable = coupling::make_test_world({{Vec3::Zero(), true}});
  EXPECT_EQ(describe_sphere_overlaps(deformable, totals(17, 17)), "");
}

}  // namespace
}  // namespace acinus::runs
