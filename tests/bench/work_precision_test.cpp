/// Work-precision benchmark on two small cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/work_precision/work_precision_report.hpp"
#include "bench/work_precision/work_precision_run.hpp"
#include "bench/work_precision/work_precision_scenes.hpp"
#include "core/error.hpp"
#include "tests/messages.hpp"

namespace acinus::bench {
namespace {

const Discretisation kSmall{42, "nodes"};

/// Two cells of 42 nodes that pull each other flat.
WorkScene two_cells() {
  return {.name = "two",
          .title = "two cells",
          .text =
              [](const Discretisation& d) {
                return R"({"name": "two", "time": {"end": "1 h"},
  "cell_types": {"cell": {"dcm": {"nodes": )" +
                       std::to_string(d.nodes) + R"(}}},
  "cells": {"source": "list", "model": "dcm", "list": [
    {"position": ["-12 um", "0 um", "0 um"]}, {"position": ["12 um", "0 um", "0 um"]}]},
  "motility": {"random": false}, "contact": {"quadrature": ")" +
                       d.quadrature + R"("}})";
              },
          .warm_up = 100,
          .warm_up_step = 20};
}

PrecisionStudy small_study() {
  PrecisionStudy s{"small", 400, 2, {.space = kSmall, .step = 2.5, .cg_tolerance = 1e-5}, {}};
  for (const double h : {20.0, 100.0})
    s.setting.push_back({.space = kSmall, .step = h, .cg_tolerance = 1e-5});
  return s;
}

TEST(WorkPrecision, ErrorFallsWithTheStepAndRunsRepeat) {
  WarmScene scene(two_cells());
  int told = 0;
  const auto outcomes = run_study(scene, small_study(), [&](const PrecisionOutcome&) { ++told; });
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(told, 2);
  for (const PrecisionOutcome& e : outcomes) {
    EXPECT_TRUE(e.failure.empty()) << e.failure;
    EXPECT_EQ(e.cells, 2);
    EXPECT_EQ(e.steps, std::lround(400 / e.setting.step));
    EXPECT_EQ(e.rejected, 0);
    EXPECT_GT(e.cpu, 0);
    EXPECT_EQ(e.main_error, e.error.pressure);
    std::printf("%s: pressure %.2g %%\n", describe(e.setting, true).c_str(), 100 * e.main_error);
  }
  EXPECT_GT(outcomes[0].main_error, 0);
  EXPECT_LT(outcomes[0].main_error, outcomes[1].main_error);
  const Trajectory a = scene.run(outcomes[1].setting, 400, 2),
                   b = scene.run(outcomes[1].setting, 400, 2);
  EXPECT_EQ(a.sample.back().pressure, b.sample.back().pressure);
  const Errors none = compute_errors(a, b);
  EXPECT_EQ(none.pressure, 0);
  EXPECT_EQ(none.contact_force, 0);
}

TEST(WorkPrecision, FixedStepThatCannotBeTakenIsTold) {
  WarmScene scene(two_cells());
  const Trajectory t = scene.run({kSmall, coupling::Integrator::kExplicitEuler, 1000}, 1e5, 1);
  EXPECT_FALSE(t.failure.empty());
  EXPECT_TRUE(t.sample.empty());
  PrecisionStudy s = small_study();
  s.window = 1e5;
  s.samples = 1;
  s.reference = {kSmall, coupling::Integrator::kExplicitEuler, 1000};
  EXPECT_THROW(run_study(scene, s), Error);
}

TEST(WorkPrecision, ErrorsGoOverAllCellsAndSamples) {
  Trajectory reference, t;
  reference.sample = {{{5, 7}, {Vec3(0, 0, 0), Vec3(4, 0, 0)}, {3, 4}, {1, 1}, {1, 0}, 0.1},
                      {{5, 7}, {Vec3(0, 0, 0), Vec3(4, 0, 0)}, {0, 0}, {1, 1}, {1, 0}, 0.1}};
  t = reference;
  t.sample[1].pressure = {1, 0};          // 1 of sqrt(9 + 16)
  t.sample[0].center[1] = Vec3(0, 6, 0);  // turned, and 2 um longer: 1 um at each end
  t.sample[1].strain = 0.2;               // 0.1 of sqrt(2) 0.1
  const Errors e = compute_errors(t, reference);
  EXPECT_DOUBLE_EQ(e.pressure, 0.2);
  EXPECT_EQ(e.volume, 0);
  EXPECT_EQ(e.contact_force, 0);
  EXPECT_DOUBLE_EQ(e.strain, 1 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(e.center_max, 1);
  EXPECT_DOUBLE_EQ(e.center_rms, 1 / std::sqrt(2.0));
}

TEST(WorkPrecision, CellsThatAreInOneRunOnlyDoNotCount) {
  Trajectory reference, t;
  reference.sample = {{{1, 2, 3}, {Vec3::Zero(), Vec3(4, 0, 0), Vec3(0, 9, 0)}, {3, 4, 5}, {}, {}}};
  for (auto* v : {&reference.sample[0].volume, &reference.sample[0].contact_force}) *v = {1, 1, 1};
  t.sample = {{{1, 2, 4}, {Vec3::Zero(), Vec3(4, 0, 0), Vec3(0, 0, 9)}, {3, 3, 50}, {}, {}}};
  t.sample[0].volume = t.sample[0].contact_force = {1, 1, 7};
  const Errors e = compute_errors(t, reference);
  EXPECT_DOUBLE_EQ(e.pressure, 0.2);  // 1 of sqrt(9 + 16)
  EXPECT_EQ(e.volume, 0);
  EXPECT_NEAR(e.center_max, 0, 1e-12);
}

TEST(WorkPrecision, CheapestIsTheLeastCpuWithinTheError) {
  std::vector<PrecisionOutcome> outcomes(4);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    outcomes[k].cpu = 4.0 - static_cast<double>(k);
    outcomes[k].main_error = 0.01 * static_cast<double>(k + 1);
    outcomes[k].window = 3600;
  }
  outcomes[1].failure = "failed";
  EXPECT_EQ(find_cheapest(outcomes, 0.025), &outcomes[0]);
  EXPECT_EQ(find_cheapest(outcomes, 0.035), &outcomes[2]);
  EXPECT_EQ(find_cheapest(outcomes, 0.005), nullptr);
  const std::string text = cheapest_text(two_cells(), outcomes);
  EXPECT_CONTAINS(text, "within 1 % on 162 nodes, 3-point: linearly-implicit, dt 60 s");
  const io::Plot plot = make_plot(two_cells(), "t", outcomes, "y",
                                  [](const PrecisionOutcome& e) { return e.main_error; });
  ASSERT_EQ(plot.line.size(), 1U);
  EXPECT_EQ(plot.line[0].point.size(), 3U) << "failed outcomes are left out";
}

TEST(WorkPrecision, TablesHaveAsManyCellsAsColumns) {
  for (const WorkCase& c :
       {stretch_case(), clump_case(), packed_case(), capsule_case(), cbm_case()}) {
    const std::string head = table_head(c.scene, c.time.front());
    PrecisionOutcome e{c.time.front().setting.front(), "", 1, 1};
    const std::string line = table_line(c.scene, e);
    const std::size_t last = head.rfind('\n', head.size() - 2);
    EXPECT_EQ(std::count(head.begin() + static_cast<std::ptrdiff_t>(last), head.end(), '|'),
              std::count(line.begin(), line.end(), '|'))
        << head << line;
  }
}

TEST(WorkPrecision, EveryStudyComparesWhatItSays) {
  for (const WorkCase& c :
       {stretch_case(), clump_case(), packed_case(), capsule_case(), cbm_case()}) {
    for (const PrecisionStudy& s : c.time)
      for (const PrecisionSetting& t : s.setting) {
        EXPECT_EQ(t.space, s.reference.space) << c.scene.name;
        if (t.integrator == s.reference.integrator && !t.adaptive) {
          EXPECT_GT(t.step, s.reference.step) << c.scene.name;
        }
      }
    for (const PrecisionStudy& s : c.space)
      for (const PrecisionSetting& t : s.setting) {
        EXPECT_LE(t.space.nodes, s.reference.space.nodes) << c.scene.name;
        EXPECT_EQ(t.step, s.reference.step) << c.scene.name;
      }
  }
}

}  // namespace
}  // namespace acinus::bench
