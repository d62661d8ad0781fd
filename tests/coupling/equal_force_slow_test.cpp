/// Deformable cell against a sphere under the same force as two of a kind: reported as measured,
/// because the law of the interface is to be judged by it.

#include <gtest/gtest.h>

#include <cstdio>

#include "contact/jkr.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Overlap 2 R - distance of two cells at rest under a force that presses them together, um.
double rest_overlap(bool second_deformable, double force) {
  const double x = second_deformable ? 12.1 : 11.95;
  World w = make_test_world({{Vec3(-12.1, 0, 0), true, Vec3(force, 0, 0)},
                             {Vec3(x, 0, 0), second_deformable, Vec3(-force, 0, 0)}},
                            300);
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, 86400));
  const Vec3 a = dcm::cell_center(w.state.dcm, 0);
  const Vec3 b =
      second_deformable ? dcm::cell_center(w.state.dcm, 1) : cbm::center_of(w.state.cbm, 0);
  return 24 - (a - b).norm();
}

TEST(EqualForceSlow, MixedPairLiesBetweenTheTwoPurePairs) {
  const double young = cbm::young_from_bulk(2.5, 0.47);
  const contact::SpherePair pair =
      contact::reduced_pair({12, young, 0.47}, {12, young, 0.47}, 0.01);
  for (double force : {0.0, 0.1, 0.2, 0.4}) {  // larger forces push free pairs past each other
    const double dd = rest_overlap(true, force), dc = rest_overlap(false, force);
    const double cc = contact::jkr_overlap(pair, force);
    std::printf(
        "F = %.1f nN: DCM-DCM %.3f, DCM-CBM %.3f, CBM-CBM %.3f um; mean of the pure pairs %.3f um, "
        "off by %.0f %%\n",
        force, dd, dc, cc, (dd + cc) / 2, 100 * (dc / ((dd + cc) / 2) - 1));
    EXPECT_GT(dc, cc);
    EXPECT_LT(dc, dd);
  }
}

}  // namespace
}  // namespace acinus::coupling
