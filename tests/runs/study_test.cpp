/// Studies as texts: what a file says, what is wrong with it, which runs it makes, and what is
/// measured on tables made by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "runs/scene/explain.hpp"
#include "runs/study/choose_runs.hpp"
#include "runs/study/curves.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/read_study.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/shipped_studies.hpp"
#include "runs/study/study_registry.hpp"
#include "runs/study/verdicts.hpp"
#include "tests/runs/study_texts.hpp"

namespace acinus::runs {
namespace {

TEST(Study, MakesARunOfEveryVariantAndSeed) {
  const StudyPlan plan = parse(text_with(""));
  EXPECT_EQ(plan.study.name, "s");
  ASSERT_EQ(plan.runs.size(), 3u);
  EXPECT_EQ(plan.runs[0].name, "fast/seed_7");
  EXPECT_EQ(plan.runs[0].folder, "runs/fast/seed_7");
  EXPECT_EQ(plan.runs[1].name, "slow/seed_1");
  EXPECT_EQ(plan.runs[0].scene.motility.grid, 30) << "its own change comes after what it extends";
  EXPECT_EQ(plan.runs[2].scene.motility.grid, 60);
  EXPECT_EQ(plan.runs[2].scene.seed, 2u);
  EXPECT_EQ(plan.runs[2].scene.time.end, 7200);
  EXPECT_EQ(plan.runs[2].scene.cells.model, CellModel::kCbm);
  EXPECT_NE(plan.runs[1].identity, plan.runs[2].identity) << "the seed is part of the scene";
}

TEST(Study, SweepsMakeVariantsWithSafeFolders) {
  const StudyPlan plan = parse(text_with(
      R"("sweeps": [ { "of": ["slow"], "key": "friction.cbm_cbm", "values": ["1e9 N s/m^3", "2e9 N s/m^3"] },
                     { "of": ["slow/*"], "key": "motility.random", "label": "on", "values": [true] } ])"));
  std::vector<std::string> names;
  for (const Variant& v : plan.variants) names.push_back(v.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "fast", "slow", "slow/cbm_cbm=1e9 N s/m^3", "slow/cbm_cbm=2e9 N s/m^3",
                       "slow/cbm_cbm=1e9 N s/m^3/on=true", "slow/cbm_cbm=2e9 N s/m^3/on=true"}));
  EXPECT_EQ(plan.variants[2].folder, "slow/cbm_cbm=1e9_N_s_m_3");
  for (const StudyRun& run : plan.runs) {
    if (plan.variant_of(run).name != names[5]) continue;
    EXPECT_EQ(run.scene.friction.cbm_cbm, 2);
    EXPECT_TRUE(run.scene.motility.random);
  }
}

TEST(Study, FaultsOfTheStudyAreToldTogetherWithTheirPlaces) {
  expect_fault(text_with(R"("seeds_": [1],
  "observables": ["mean_presure"],
  "plots": [ { "name": "p", "observable": "cels", "variants": ["slwo"] } ])"),
               {"s.json:9:3 /seeds_: unknown key. Did you mean \"seeds\"? (acinus explain "
                "study.seeds)",
                "s.json:10:19 /observables/0", "s.json:11:43 /plots/0/observable",
                "s.json:11:64 /plots/0/variants/0", "Did you mean \"slow\"?"});
}

TEST(Study, RefusesTimesAfterTheEndOfTheRuns) {
  expect_fault(text_with(R"("expectations": [ { "id": "a", "claim": "c", "low": 1,
    "measure": { "observable": "cells", "variant": "slow", "at": "3 h" } } ])"),
               {"s.json:10:66 /expectations/0/measure/at", "after the end of slow at 2 h"});
}

TEST(Study, KnowsTheWallsThatScenesMake) {
  const auto fault = [](const std::string& observable) {
    return fault_of(R"x({ "scene": "regeneration", "variants": { "a": {} }, "observables": [")x" +
                    observable + "\"] }");
  };
  EXPECT_EQ(fault("wall_radial_low_force_nN"), "");
  EXPECT_CONTAINS(fault("wall_left_force_nN"), "/observables/0");
}

TEST(Study, RefusesASeedTwice) {
  std::string text = text_with("");
  text.replace(text.find("[1, 2]"), 6, "[1, 2, 1]");
  expect_fault(text, {"s.json:4:19 /seeds/2 = 1: stands there twice"});
  expect_fault(text_with("", R"("a": { "seeds": [3, 3] })"),
               {"/variants/a/seeds/1 = 3: stands there twice"});
}

TEST(Study, RefusesVariantsThatExtendOrStartFromNobodyOrInACircle) {
  expect_fault(text_with("", R"("abc": { "extends": "abd" }, "abx": {})"),
               {"s.json:5:", "/variants/abc/extends: no variant \"abd\". Did you mean \"ab"});
  expect_fault(text_with("", R"("a": { "extends": "b" }, "b": { "extends": "a" })"),
               {"/variants/a/extends: variants extend each other in a circle: b, a, b"});
  const std::string start = R"("set": { "start_up.enabled": true })";
  expect_fault(text_with("", R"("a": { "start": "b", )" + start + R"( }, "b": { "start": "a", )" +
                                 start + " }"),
               {"/variants/a/start: variants start from each other in a circle"});
  expect_fault(text_with("", R"("a": { "start": "c" })"), {"/variants/a/start: no variant \"c\""});
  expect_fault(text_with("", R"("a": { "start": "b", "seeds": [5] }, "b": {})"),
               {"/variants/a/start: \"b\" has no run with seed 5"});
}

TEST(Study, RefusesAStartThatCannotBeShared) {
  expect_fault(text_with("", R"("a": { "start": "b" }, "b": {})"),
               {"/variants/a/start", "has no start_up"});
  expect_fault(text_with("", R"(
    "b": { "set": { "start_up.enabled": true } },
    "a": { "extends": "b", "start": "b",
           "set": { "motility.random": true, "contact.skin": "0.2 um" } })"),
               {"s.json:7:37 /variants/a/start", "/contact/skin", "must be the same"});
  EXPECT_EQ(fault_of(text_with("", R"(
    "b": { "set": { "start_up.enabled": true } },
    "a": { "extends": "b", "start": "b", "set": { "motility.random": true } })")),
            "");
}

TEST(Study, FaultsOfScenesStandAtTheStudysLines) {
  expect_fault(
      text_with("", R"(
    "a": { "set": { "motility.gird": "60 s", "time.step": "60" } },
    "b": { "set": { "time.step.x": 1, "seed": 3 } })"),
      {"s.json:6:21 /motility/gird: unknown key. Did you mean \"grid\"?",
       "s.json:6:59 /time/step = \"60\"", "s.json:7:39 /variants/b/set/seed: cannot be set"});
  expect_fault(text_with(R"("sweeps": [
    { "of": ["slow"], "key": "motility.leader_froce", "values": ["0.1 nN"] },
    { "of": ["slow"], "key": "motility.leader_force", "values": ["0.1 nN", "-1 nN", "1 um"] },
    { "of": ["nobody"], "key": "seed", "values": [] } ])"),
               {"s.json:10:66 /motility/leader_froce: unknown key",
                "s.json:11:76 /motility/leader_force = \"-1 nN\": must be >= 0 nN",
                "s.json:11:85 /motility/leader_force = \"1 um\"", "s.json:12:"});
}

TEST(Study, RefusesTheSameVariantTwice) {
  expect_fault(text_with(R"("sweeps": [
    { "of": ["slow"], "key": "motility.grid", "values": ["1 s", "1 s"] } ])"),
               {"s.json:10:65 /sweeps/0/values/1 = \"1 s\": makes the variant \"slow/grid=1 s\"",
                "a label"});
}

TEST(Study, RefusesBadClaims) {
  expect_fault(
      text_with(R"("expectations": [
    { "id": "a", "claim": "x", "measure": { "observable": "cells", "variant": "slow" } },
    { "id": "a", "claim": "x", "measure": { "kind": "first_below", "observable": "overlap_cbm_cbm_um",
      "variant": "none", "level": 1 }, "low": "1 um" },
    { "id": "b", "claim": "x", "measure": { "kind": "valeu", "observable": "cells", "variant": "slow" }, "low": 1 },
    { "id": "c", "claim": "x", "measure": { "observable": "cells", "variant": "slow", "from": "1 h" },
      "minus": { "observable": "overlap_cbm_cbm_um", "variant": "slow" }, "high": "1 s" } ])"),
      {"/expectations/0/low: is missing", "/expectations/1/id",
       "/expectations/1/measure/variant = \"none\": no variant",
       "/expectations/1/measure/level = 1", "/expectations/1/low = \"1 um\": has dimension length",
       "/expectations/2/measure/kind = \"valeu\": unknown choice", "/expectations/3/measure/from",
       "/expectations/3/minus = {...}: is in um, the first measure in 1"});
}

TEST(Study, SchemaAndExplainKnowItsKeys) {
  const nlohmann::json schema = nlohmann::json::parse(study_schema());
  EXPECT_TRUE(schema["properties"].contains("variants"));
  EXPECT_TRUE(schema["properties"]["expectations"]["items"]["properties"].contains("measure"));
  for (const Entry& entry : study_entries())
    EXPECT_NO_THROW(explain_key(entry.path, study_entries())) << entry.path;
  EXPECT_CONTAINS(explain_key("study.measure.kind", study_entries()), "p_value");
  EXPECT_THROW(explain_key("study.measure.knid", study_entries()), Error);
}

TEST(Study, TasksShareTheRunsWithoutLossOrOverlap) {
  const StudyPlan plan = parse(text_with(
      R"("sweeps": [ { "of": ["slow"], "key": "time.end", "values": ["1 h", "2 h", "3 h", "4 h"] } ])"));
  std::vector<int> times(plan.runs.size(), 0);
  for (int task = 1; task <= 3; ++task)
    for (const ChosenRun& c : choose_runs(plan, {{}, task, 3})) ++times[c.run];
  EXPECT_EQ(times, std::vector<int>(plan.runs.size(), 1));
  EXPECT_EQ(choose_runs(plan, {{"slow/*"}, 1, 1}).size(), 8u);
  EXPECT_THROW(choose_runs(plan, {{"slwo"}, 1, 1}), Error);
}

TEST(Study, ARunThatOthersStartFromComesFirstAndToEveryTaskThatNeedsIt) {
  const StudyPlan plan = parse(text_with("", R"(
    "b": { "set": { "start_up.enabled": true } },
    "a": { "extends": "b", "start": "b", "set": { "motility.random": true } })"));
  const std::vector<ChosenRun> all = choose_runs(plan, {});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(plan.runs[all[0].run].name, "b/seed_1");
  EXPECT_EQ(plan.runs[all[1].run].name, "a/seed_1");
  const std::vector<ChosenRun> only = choose_runs(plan, {{"a"}, 1, 1});
  ASSERT_EQ(only.size(), 4u);
  EXPECT_FALSE(only[0].own);
  EXPECT_TRUE(only[1].own);
  EXPECT_EQ(plan.runs[0].identity, plan.runs[0].scene.hash + "<" + plan.runs[2].scene.hash);
}

TEST(Study, ShippedOnesAreSound) {
  const std::vector<ShippedScene> shipped = shipped_studies();
  EXPECT_FALSE(shipped.empty());
  for (const ShippedScene& study : shipped) {
    EXPECT_NO_THROW(EXPECT_FALSE(read_study(study.file).runs.empty())) << study.file;
    EXPECT_FALSE(study.description.empty()) << study.name;
    EXPECT_EQ(find_study(study.name), study.file);
  }
  EXPECT_THROW(find_study("exmaple"), Error);
}

TEST(Curves, AreReadBetweenSamplesAndNowhereElse) {
  const TimeCurve c{{0, 10, 20}, {1, 3, 2}};
  EXPECT_EQ(value_at(c, 5), 2);
  EXPECT_EQ(value_at(c, 20), 2);
  EXPECT_FALSE(value_at(c, 21));
  EXPECT_EQ(first_passage(c, 2, false, 0, 20), 5);
  EXPECT_EQ(first_passage(c, 2.5, true, 10, 20), 15);
  EXPECT_FALSE(first_passage(c, 0, true, 0, 20));
  EXPECT_FALSE(first_passage(c, 2, true, 12, 18)) << "the window has no sample at or below";
  EXPECT_DOUBLE_EQ(time_mean(window(c, 0, 20)), (20 + 25) / 20.0);
  EXPECT_DOUBLE_EQ(time_mean(window(c, 5, 15)), (2.5 * 5 + 2.75 * 5) / 10);
  EXPECT_TRUE(window(c, 0, 30).time.empty());
}

TEST(Curves, WelchsTestAgreesWithAWorkedExample) {
  const std::vector<double> a{1, 2, 3, 4, 5}, b{2, 4, 6, 8, 10};
  // t^2 = 9 / (0.5 + 2) = 3.6 with 2.5^2 / (0.25 / 4 + 4 / 4) = 5.88 degrees of freedom; p by
  // Simpson's rule over the density of t in two million steps, in another language.
  EXPECT_NEAR(welch_p(a, b).value(), 0.10753119493, 1e-10);
  EXPECT_NEAR(welch_p(a, a).value(), 1, 1e-12);
  EXPECT_FALSE(welch_p({1}, b));
  EXPECT_FALSE(welch_p({1, 1}, {2, 2}));
  // One degree of freedom in each of two pairs of equal spread: nu = 2, where
  // p = 1 - t / sqrt(2 + t^2) in closed form; t^2 = 16 / (1 + 1) = 8.
  EXPECT_NEAR(welch_p({0, 2}, {4, 6}).value(), 1 - std::sqrt(8.0 / 10), 1e-12);
}

TEST(Curves, PairedTestLooksAtDifferences) {
  // Differences -1 -2 -1: t^2 = (16 / 9) / (1 / 9) with two degrees of freedom.
  EXPECT_NEAR(paired_p({1, 2, 4}, {2, 4, 5}).value(), 1 - 4 / std::sqrt(18.0), 1e-12);
  EXPECT_FALSE(paired_p({1}, {2}));
  EXPECT_FALSE(paired_p({1, 2}, {2, 3}));
}

TEST(Study, UnitsOfObservablesAreUnderstood) {
  EXPECT_DOUBLE_EQ(scale_of_unit("kPa").in_base, 1);
  EXPECT_DOUBLE_EQ(scale_of_unit("1/mm^3").in_base, 1e-9);
  EXPECT_EQ(scale_of_unit("1").dimension, kDimensionless);
  EXPECT_EQ(unit_of_key("motility.leader_force"), "nN");
  EXPECT_EQ(unit_of_key("cell_types.hepatocyte.dcm.nodes"), "1");
  EXPECT_EQ(unit_of_key("rules.0.half_max"), "1");
  EXPECT_FALSE(unit_of_key("motility.random"));
  EXPECT_FALSE(unit_of_key("motility.leader_froce"));
}

}  // namespace
}  // namespace acinus::runs
