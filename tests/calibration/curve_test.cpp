/// Force-overlap curves: the loading branch, interpolation, common range, error.

#include "calibration/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/fit_law.hpp"

namespace acinus::calibration {
namespace {

TEST(ForceCurve, LoadingBranchIsTheLastRiseToTheLargestOverlap) {
  const std::vector<double> d{0.12, 0.11, 0.07, 0.08, 0.10, 0.15, 0.14}, f{0, 1, 2, 3, 4, 5, 6};
  const ForceCurve c = loading_branch(d, f);
  EXPECT_EQ(c.overlap, (std::vector<double>{0.07, 0.08, 0.10, 0.15}));
  EXPECT_EQ(c.force, (std::vector<double>{2, 3, 4, 5}));
  EXPECT_TRUE(loading_branch({}, {}).empty());
}

TEST(ForceCurve, InterpolatesLinearlyAndHoldsItsEnds) {
  const ForceCurve c{{0.1, 0.2}, {1, 3}};
  EXPECT_DOUBLE_EQ(force_at(c, 0.15), 2);
  EXPECT_DOUBLE_EQ(force_at(c, 0.1), 1);
  EXPECT_DOUBLE_EQ(force_at(c, 0.2), 3);
}

TEST(ForceCurve, CommonOverlapsCoverWhatAllCover) {
  const ForceCurve a{{0.05, 0.2}, {1, 2}}, b{{0.1, 0.3}, {1, 2}}, far{{0.25, 0.3}, {1, 2}};
  const ForceCurve* both[] = {&a, &b};
  const std::vector<double> d = common_overlaps(both, 0.18, 5);
  ASSERT_EQ(d.size(), 5u);
  EXPECT_DOUBLE_EQ(d.front(), 0.1);
  EXPECT_DOUBLE_EQ(d.back(), 0.18);
  const ForceCurve* apart[] = {&a, &far};
  EXPECT_TRUE(common_overlaps(apart, 0.5, 5).empty());
}

TEST(ForceCurve, RelativeErrorOfAConstantFactorIsThatFactor) {
  const ForceCurve target{{0.05, 0.1, 0.2}, {1, 2, 8}}, spheres{{0.05, 0.1, 0.2}, {1.1, 2.2, 8.8}};
  EXPECT_NEAR(relative_error(target, spheres, 0.2), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(relative_error(target, {{0.3, 0.4}, {1, 2}}, 0.2)));
}

TEST(ForceCurve, LastRiseIsWhereAHistoryGoesThroughAValueForGood) {
  const std::vector<double> history{0, 4, 1, 3, 5};
  EXPECT_DOUBLE_EQ(find_last_rise(history, 2), 2.5);
  EXPECT_DOUBLE_EQ(find_last_rise(history, 1), 2);
  EXPECT_TRUE(std::isnan(find_last_rise(history, 5)));
  EXPECT_TRUE(std::isnan(find_last_rise({}, 5)));
}

}  // namespace
}  // namespace acinus::calibration
