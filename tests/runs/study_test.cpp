/// Studies as texts: what a file says, what is wrong with it, which runs it makes, and what is
/// measured on tables made by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/unit_scale.hpp"
#include "runs/scene/explain.hpp"
#include "runs/study/choose_runs.hpp"
#include "runs/study/curves.hpp"
#include "runs/study/library.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/registry.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/study_data.hpp"
#include "runs/study/study_maps.hpp"
#include "runs/study/study_plots.hpp"
#include "runs/study/verdicts.hpp"

namespace acinus::runs {
namespace {

/// A study of two spheres; `more` stands after its variants.
std::string text_with(const std::string& more, const std::string& variants = R"(
    "slow": { "set": { "motility.grid": "60 s" } },
    "fast": { "extends": "slow", "set": { "motility.grid": "30 s" }, "seeds": [7] })") {
  return R"({
  "scene": "two_cells",
  "set": { "cells.model": "cbm", "time.end": "2 h" },
  "seeds": [1, 2],
  "variants": {)" +
         variants + "\n  }" + (more.empty() ? "" : ",\n  " + more) + "\n}\n";
}

StudyPlan parse(const std::string& text) { return parse_study(text, "s.json"); }

std::string fault_of(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Exit::kBadInput) << error.what();
    return error.what();
  }
  return "no fault";
}

void expect_fault(const std::string& text, const std::vector<std::string>& parts) {
  const std::string fault = fault_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(fault.find(part), std::string::npos) << part << "\nis not in\n" << fault;
}

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
  EXPECT_EQ(fault("wall_radial_low_force_nN"), "no fault");
  EXPECT_NE(fault("wall_left_force_nN").find("/observables/0"), std::string::npos);
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
            "no fault");
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
  EXPECT_NE(explain_key("study.measure.kind", study_entries()).find("p_value"), std::string::npos);
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
  EXPECT_FALSE(unit_of_key("motility.random"));
  EXPECT_FALSE(unit_of_key("motility.leader_froce"));
}

/// Two seeds of "slow", one of "fast", with one observable each.
class Claims : public testing::Test {
 protected:
  StudyPlan plan(const std::string& expectation) {
    return parse(text_with("\"expectations\": [ " + expectation + " ]"));
  }
  static std::string claim(const std::string& measure, const std::string& rest) {
    return R"({ "id": "c", "claim": "x", "measure": { "observable": "overlap_cbm_cbm_um", )" +
           measure + " }, " + rest + " }";
  }
  static StudyData data() {
    StudyData all(3);
    const std::vector<double> hours{0, 3600, 7200};
    all[0].curve["overlap_cbm_cbm_um"] = {hours, {4, 4, 4}};  // fast/seed_7
    all[1].curve["overlap_cbm_cbm_um"] = {hours, {1, 2, 3}};  // slow/seed_1
    all[2].curve["overlap_cbm_cbm_um"] = {hours, {1, 4, 5}};  // slow/seed_2
    for (RunData& d : all) {
      d.status.state = RunState::kDone;
      d.until = 7200;
    }
    return all;
  }
  Verdict checked(const std::string& measure, const std::string& rest,
                  const StudyData& d = data()) {
    return check_claims(plan(claim(measure, rest)), d).at(0);
  }
};

TEST_F(Claims, ValueIsTheMeanOfTheSeedsAndTheBandTheirRange) {
  const Verdict v =
      checked(R"("variant": "slow", "at": "1 h")", R"("low": "2 um", "high": "3 um")");
  EXPECT_EQ(v.measured.value, 3);
  EXPECT_EQ(v.measured.low, 2);
  EXPECT_EQ(v.measured.high, 4);
  EXPECT_EQ(v.measured.unit, "um");
  EXPECT_EQ(v.status, ClaimStatus::kHolds);
  EXPECT_EQ(v.expected, "from 2 um to 3 um");
  EXPECT_EQ(checked(R"("variant": "slow")", R"("high": "3.9 um")").status,
            ClaimStatus::kDoesNotHold)
      << "at the end the mean is 4";
  EXPECT_EQ(
      checked(R"("variant": "slow", "at": "1 h")", R"("high": "3 um", "every_seed": true)").status,
      ClaimStatus::kDoesNotHold)
      << "one seed has 4";
}

TEST_F(Claims, EveryKindOfMeasure) {
  const std::string any = R"("low": 0)", um = R"("low": "0 um")", s = R"("low": "0 s")";
  const auto value = [&](const std::string& kind, const std::string& more, const std::string& low) {
    return checked("\"kind\": \"" + kind + "\", \"variant\": \"slow\"" + more, low)
        .measured.value.value();
  };
  EXPECT_EQ(value("first_above", R"(, "level": "2 um")", s), (3600 + 1200) / 2.0);
  EXPECT_EQ(value("mean", R"(, "from": "0 h", "until": "2 h")", um), (2 + 3.5) / 2);
  EXPECT_EQ(value("min", R"(, "from": "1 h")", um), 3);
  EXPECT_EQ(value("max", "", um), 4);
  EXPECT_EQ(value("band", "", um), 2);
  EXPECT_EQ(value("distance", R"(, "other": "fast")", um), 3);
  EXPECT_EQ(value("outside", R"(, "other": "fast", "another": "fast")", um), 3);
  EXPECT_EQ(value("outside", R"(, "other": "fast", "another": "slow")", um), 0);
  const Verdict p = checked(R"("kind": "p_value", "variant": "slow", "other": "fast")", any);
  EXPECT_EQ(p.status, ClaimStatus::kNotMeasured) << "one seed has no spread";
  EXPECT_FALSE(p.measured.note.empty());
}

TEST_F(Claims, DifferencesAndRatiosAreTakenSeedBySeed) {
  const std::string second =
      R"({ "observable": "overlap_cbm_cbm_um", "variant": "slow", "at": "0 h" })";
  Verdict v =
      checked(R"("variant": "slow", "at": "2 h")", "\"minus\": " + second + R"(, "low": "2 um")");
  EXPECT_EQ(v.measured.value, 3);
  EXPECT_EQ(v.measured.low, 2);
  EXPECT_EQ(v.measured.high, 4);
  v = checked(R"("variant": "slow", "at": "2 h")", "\"over\": " + second + R"(, "low": 4)");
  EXPECT_EQ(v.measured.value, 4);
  EXPECT_EQ(v.measured.unit, "1");
  v = checked(R"("variant": "fast", "at": "2 h")", "\"over\": " + second + R"(, "low": 4)");
  EXPECT_EQ(v.measured.value, 4) << "other seeds: of the means";
  EXPECT_FALSE(v.measured.low.has_value());
}

TEST_F(Claims, WhatNeverHappensIsLaterThanTheRun) {
  const std::string never = R"("kind": "first_above", "variant": "slow", "level": "9 um")";
  Verdict v = checked(never, R"("high": "1 h")");
  EXPECT_EQ(v.status, ClaimStatus::kDoesNotHold);
  EXPECT_NE(v.measured.note.find("never"), std::string::npos);
  EXPECT_EQ(checked(never, R"("low": "2 h")").status, ClaimStatus::kHolds);
  EXPECT_EQ(checked(never, R"("low": "3 h")").status, ClaimStatus::kNotMeasured)
      << "the runs say nothing about what comes after two hours";
}

TEST_F(Claims, OneSeedInWhichSomethingNeverHappensDoesNotDecideForAll) {
  // Seed 1 ends at 3 um, seed 2 at 4 um.
  Verdict v = checked(R"("kind": "first_above", "variant": "slow", "level": "3.5 um")",
                      R"("low": "30 min", "every_seed": true)");
  EXPECT_TRUE(std::isinf(v.measured.high.value()));
  EXPECT_NE(v.measured.note.find("1 of 2 seeds never"), std::string::npos) << v.measured.note;
  // A ratio with what never happens is no ratio; zero it is not.
  const std::string never =
      R"({ "kind": "first_above", "observable": "overlap_cbm_cbm_um", "variant": "slow", "level": "9 um" })";
  v = checked(R"("kind": "first_above", "variant": "slow", "level": "2 um")",
              "\"over\": " + never + R"(, "low": 0, "high": 1)");
  EXPECT_EQ(v.status, ClaimStatus::kNotMeasured);
  // Two hours were looked at and 2 um come after 40 min on average, so it is sooner by 1 h at
  // least.
  const std::string sooner = R"("kind": "first_above", "variant": "slow", "level": "2 um")";
  EXPECT_EQ(checked(sooner, "\"minus\": " + never + R"(, "high": "-30 min")").status,
            ClaimStatus::kHolds);
  EXPECT_EQ(checked(sooner, "\"minus\": " + never + R"(, "high": "-3 h")").status,
            ClaimStatus::kNotMeasured);
  // Other seeds, so of the means: later by 80 min at least, and nobody knows about 3 h.
  const std::string later = R"("kind": "first_above", "variant": "fast", "level": "9 um")";
  const std::string slow =
      R"({ "kind": "first_above", "observable": "overlap_cbm_cbm_um", "variant": "slow", "level": "2 um" })";
  EXPECT_EQ(checked(later, "\"minus\": " + slow + R"(, "low": "1 h")").status, ClaimStatus::kHolds);
  EXPECT_EQ(checked(later, "\"minus\": " + slow + R"(, "low": "3 h")").status,
            ClaimStatus::kNotMeasured);
}

TEST_F(Claims, MissingAndFailedRunsAreNeverAPass) {
  for (const RunState state : {RunState::kFailed, RunState::kToDo, RunState::kToResume}) {
    StudyData d = data();
    d[2].status.state = state;
    if (state == RunState::kToDo) d[2].curve.clear();
    EXPECT_EQ(checked(R"("variant": "slow")", R"("low": "0 um")", d).status,
              ClaimStatus::kNotMeasured);
  }
  StudyData d = data();
  d[2].status.state = RunState::kToResume;
  EXPECT_EQ(checked(R"("variant": "slow", "at": "1 h")", R"("low": "0 um")", d).status,
            ClaimStatus::kHolds)
      << "a run that was cut short has passed one hour";
}

TEST_F(Claims, CurvesThatEndApartAreNotLaidOverEachOther) {
  StudyData d = data();
  TimeCurve& late = d[2].curve.at("overlap_cbm_cbm_um");  // slow/seed_2
  late = {{0, 3600}, {1, 4}};
  d[2].until = 3600;
  const std::string low = R"("low": "0 um")", over = R"(, "other": "slow")";
  const auto status = [&](const std::string& measure, const StudyData& of) {
    return checked(measure, low, of).status;
  };
  const std::string distance = R"("kind": "distance", "variant": "fast")" + over,
                    band = R"("kind": "band", "variant": "slow")";
  for (const std::string& measure : {distance, band}) {
    EXPECT_EQ(status(measure, data()), ClaimStatus::kHolds) << measure;
    EXPECT_EQ(status(measure, d), ClaimStatus::kNotMeasured) << measure;
    EXPECT_EQ(status(measure + R"(, "until": "1 h")", d), ClaimStatus::kHolds) << measure;
  }
  EXPECT_EQ(checked(band, low, d).measured.note,
            "the runs end at different times, from 1 h to 2 h: give the claim an until");
  // The same for their beginnings.
  d = data();
  d[2].curve.at("overlap_cbm_cbm_um") = {{3600, 7200}, {4, 5}};
  EXPECT_EQ(status(band, d), ClaimStatus::kNotMeasured);
  EXPECT_EQ(status(band + R"(, "from": "1 h")", d), ClaimStatus::kHolds);
}

TEST_F(Claims, TheEndIsThatOfTheRunAndNotOfTheLastValue) {
  StudyData d = data();
  d[2].curve.at("overlap_cbm_cbm_um") = {{0, 3600}, {1, 4}};  // recorded until 2 h
  for (const char* kind : {"value", "mean", "max", "min", "band"}) {
    const Verdict v = checked(std::string("\"kind\": \"") + kind + R"(", "variant": "slow")",
                              R"("low": "0 um")", d);
    EXPECT_EQ(v.status, ClaimStatus::kNotMeasured) << kind;
    EXPECT_NE(v.measured.note, "") << kind;
  }
  for (const RunState state : {RunState::kRefused, RunState::kKilled}) {
    d = data();
    d[1].status.state = state;
    const Verdict v = checked(R"("variant": "slow")", R"("low": "0 um")", d);
    EXPECT_EQ(v.status, ClaimStatus::kNotMeasured);
    EXPECT_EQ(v.measured.note, std::string("slow/seed_1 ") + name_of(state));
  }
}

TEST_F(Claims, PlotsHaveMeanBandAndReferencePoints) {
  const StudyPlan p =
      parse(text_with(R"("plots": [ { "name": "m", "observable": "overlap_cbm_cbm_um",
    "reference": [ { "name": "paper", "x": ["1 h"], "y": ["2 um"], "low": ["1 um"], "high": ["3 um"] } ] } ])"));
  const io::Plot plot = make_plot(p, data(), p.study.plots[0]);
  ASSERT_EQ(plot.line.size(), 3u);
  EXPECT_EQ(plot.line[1].point[1], (std::pair<double, double>(1, 3))) << "hours";
  EXPECT_EQ(plot.line[1].band[1], (std::pair<double, double>(2, 4)));
  EXPECT_FALSE(plot.line[2].joined);
  EXPECT_EQ(plot.line[2].point[0], (std::pair<double, double>(1, 2)));
  EXPECT_EQ(plot.y_label, "overlap_cbm_cbm, um");
}

TEST_F(Claims, PlotsLeaveOutRunsThatFailedAndSaySo) {
  const StudyPlan p =
      parse(text_with(R"("plots": [ { "name": "m", "observable": "overlap_cbm_cbm_um" } ])"));
  StudyData d = data();
  d[2].status.state = RunState::kFailed;
  const io::Plot plot = make_plot(p, d, p.study.plots[0]);
  ASSERT_EQ(plot.line.size(), 2u);
  EXPECT_TRUE(plot.line[1].name.ends_with(" (1 of 2 seeds)")) << plot.line[1].name;
  EXPECT_EQ(plot.line[1].band[1].first, plot.line[1].band[1].second);
}

TEST_F(Claims, MapsShowTheShareOfSeedsWithinBounds) {
  const StudyPlan p = parse(text_with(R"("maps": [ { "name": "m", "x": "motility.grid",
    "y": "time.end", "measure": { "observable": "overlap_cbm_cbm_um", "at": "1 h" }, "high": "3 um" } ])"));
  io::HeatMap map = make_map(p, data(), p.study.maps[0]);
  ASSERT_EQ(map.column.size(), 2u) << "30 and 60 s";
  ASSERT_EQ(map.row.size(), 1u);
  EXPECT_EQ(map.field[0][1].share, 0.5) << "slow: 2 and 4 um after an hour";
  EXPECT_EQ(map.field[0][1].text[1], "1 of 2 seeds");
  StudyData d = data();
  d[2].status.state = RunState::kFailed;
  map = make_map(p, d, p.study.maps[0]);
  EXPECT_FALSE(map.field[0][1].share) << "a failed run is not a seed less";
  expect_fault(text_with(R"("maps": [ { "name": "m", "x": "cells", "y": "time.end",
    "measure": { "observable": "overlap_cbm_cbm_um" } } ])"),
               {"/maps/0/x", "is no key of a scene with one number as value", "/maps/0/low"});
}

TEST_F(Claims, SoManySeedsMustLieWithinBounds) {
  const std::string slow = R"("variant": "slow", "at": "1 h")";  // 2 and 4 um
  EXPECT_EQ(checked(slow, R"("high": "3 um", "least_seeds": 1)").status, ClaimStatus::kHolds);
  EXPECT_EQ(checked(slow, R"("high": "3 um", "least_seeds": 2)").status, ClaimStatus::kDoesNotHold);
  EXPECT_EQ(checked(slow, R"("high": "3 um", "least_seeds": 1)").expected,
            "at most 3 um, at least 1 seeds");
  expect_fault(text_with(R"("expectations": [ { "id": "A", "claim": "c", "every_seed": true,
    "least_seeds": 1, "measure": { "observable": "overlap_cbm_cbm_um", "variant": "slow" },
    "low": "0 um" } ])"),
               {"/expectations/0/least_seeds", "give one of the two"});
}

TEST(Study, JudgesAClaimForEachValueOfASweep) {
  const std::string sweep =
      R"("sweeps": [ { "of": ["slow", "fast"], "key": "time.end", "label": "T", "values": ["1 h", "90 min"] } ],)";
  const std::string claim =
      R"("expectations": [ { "id": "A", "claim": "c", "each": "T", "low": 0,
      "measure": { "observable": "overlap_cbm_cbm_um", "variant": "slow" },
      "over": { "observable": "overlap_cbm_cbm_um", "variant": "fast" } } ])";
  const StudyPlan plan = parse(text_with(sweep + claim));
  ASSERT_EQ(plan.study.expectations.size(), 3u);
  EXPECT_EQ(plan.study.expectations[1].id, "A/T=1 h");
  EXPECT_EQ(plan.study.expectations[2].measure.variant, "slow/T=90 min");
  EXPECT_EQ(plan.study.expectations[2].over->variant, "fast/T=90 min");
  const std::string one =
      R"("sweeps": [ { "of": ["slow"], "key": "time.end", "label": "T", "values": ["1 h"] } ],)";
  expect_fault(text_with(one + claim), {"/expectations/0/each", "no variant fast/T=1 h"});
  expect_fault(text_with(claim), {"/expectations/0/each", "no sweep with this label"});
}

TEST(Study, SweptVariantsStartFromTheirTwins) {
  const StudyPlan plan = parse(text_with(
      R"("sweeps": [ { "of": ["a", "b"], "key": "motility.grid", "label": "g", "values": ["20 s"] } ])",
      R"("a": { "set": { "start_up.enabled": true } }, "b": { "extends": "a", "start": "a" })"));
  const auto variant = [&](const char* name) {
    return plan.variants[find_variants(plan.variants, name).at(0)];
  };
  EXPECT_EQ(variant("b").start, "a");
  EXPECT_EQ(variant("b/g=20 s").start, "a/g=20 s");
}

TEST_F(Claims, VerdictsAreJsonWithoutNaN) {
  const std::string root = testing::TempDir() + "verdicts";
  std::filesystem::create_directories(root);
  StudyData d = data();
  d[1].status.state = RunState::kFailed;
  const StudyPlan p = plan(claim(R"("variant": "slow")", R"("low": "0 um")"));
  write_verdicts(check_claims(p, d), root);
  std::ifstream file(root + "/verdicts.json");
  const nlohmann::json j = nlohmann::json::parse(file);
  for (const char* key : {"claim", "expected", "measured", "low", "high", "pass"})
    EXPECT_TRUE(j[0].contains(key)) << key;
  EXPECT_TRUE(j[0]["measured"].is_null());
  EXPECT_TRUE(j[0]["pass"].is_null());
  EXPECT_NE(j[0]["note"].get<std::string>().find("slow/seed_1 failed"), std::string::npos);
}

}  // namespace
}  // namespace acinus::runs
