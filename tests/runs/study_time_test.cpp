/// Remaining time of a study, and the records of its runs.

#include <gtest/gtest.h>

#include "runs/study/active_run.hpp"
#include "runs/study/expected_cost.hpp"
#include "runs/study/read_study.hpp"

namespace acinus::runs {
namespace {

StudyPlan make_plan() {
  return parse_study(R"({
  "scene": "two_cells",
  "set": { "cells.model": "cbm", "time.end": "2 h" },
  "seeds": [1, 2],
  "variants": { "spheres": {}, "cells": { "set": { "cells.model": "dcm" } } }
})",
                     "s.json");
}

constexpr const char* kNowhere = "/nowhere/study";

TEST(TimeLeftOfAStudy, IsNotToldWhereItWouldRestOnRoughEstimates) {
  const StudyPlan plan = make_plan();
  ExpectedCosts costs(plan, kNowhere);
  EXPECT_FALSE(estimate_time_left(plan, costs, {0}, {}, 1).has_value());
  EXPECT_FALSE(estimate_time_left(plan, costs, {}, {{0, 5, {}}}, 1).has_value());
  EXPECT_EQ(estimate_time_left(plan, costs, {}, {{0, 5, 7.0}}, 1), 7.0) << "by its own estimate";
  costs.add(plan.runs[0], 30);
  EXPECT_EQ(estimate_time_left(plan, costs, {1}, {}, 1), 30.0) << "the other seed";
  EXPECT_FALSE(estimate_time_left(plan, costs, {1, 2}, {}, 1).has_value()) << "the other model";
}

TEST(TimeLeftOfAStudy, CountsWhatRunningOnesHaveDone) {
  const StudyPlan plan = make_plan();
  ExpectedCosts costs(plan, kNowhere);
  costs.add(plan.runs[0], 30);
  costs.add(plan.runs[2], 100);
  EXPECT_EQ(estimate_time_left(plan, costs, {}, {{1, 20, {}}}, 2), 10.0);
  EXPECT_EQ(estimate_time_left(plan, costs, {}, {{1, 50, {}}}, 2), 0.0);
  EXPECT_EQ(estimate_time_left(plan, costs, {1}, {{3, 50, 90.0}}, 2), 90.0) << "the longest";
  EXPECT_EQ(estimate_time_left(plan, costs, {0, 1}, {{3, 50, 90.0}}, 1), 150.0);
}

TEST(TimeLeftOfAStudy, ARunThatCannotTellYetTellsTheRest) {
  const RunProgress early =
      parse_progress(R"({"phase":"running","time_s":60,"end_s":7200,"wall_s":1.5,"eta_s":null})");
  EXPECT_FALSE(early.left_s.has_value());
  EXPECT_EQ(early.time_s, 60);
  EXPECT_EQ(early.wall_s, 1.5);
  EXPECT_FALSE(early.starting);
  EXPECT_EQ(parse_progress(R"({"phase":"running","eta_s":12.5})").left_s, 12.5);
  EXPECT_TRUE(parse_progress("").starting);
}

}  // namespace
}  // namespace acinus::runs
