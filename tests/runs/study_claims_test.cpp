/// Claims of studies, judged on tables made by hand, and their plots and maps.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/study/choose_runs.hpp"
#include "runs/study/curves.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/study_data.hpp"
#include "runs/study/study_maps.hpp"
#include "runs/study/study_plots.hpp"
#include "runs/study/verdicts.hpp"
#include "tests/runs/scene_texts.hpp"
#include "tests/runs/study_texts.hpp"

namespace acinus::runs {
namespace {

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
  EXPECT_CONTAINS(v.measured.note, "never");
  EXPECT_EQ(checked(never, R"("low": "2 h")").status, ClaimStatus::kHolds);
  EXPECT_EQ(checked(never, R"("low": "3 h")").status, ClaimStatus::kNotMeasured)
      << "the runs say nothing about what comes after two hours";
}

TEST_F(Claims, OneSeedInWhichSomethingNeverHappensDoesNotDecideForAll) {
  // Seed 1 ends at 3 um, seed 2 at 4 um.
  Verdict v = checked(R"("kind": "first_above", "variant": "slow", "level": "3.5 um")",
                      R"("low": "30 min", "every_seed": true)");
  EXPECT_TRUE(std::isinf(v.measured.high.value()));
  EXPECT_CONTAINS(v.measured.note, "1 of 2 seeds never");
  // A ratio with what never happens is no ratio; zero it is not.
  const std::string never =
      R"({ "kind": "first_above", "observable": "overlap_cbm_cbm_um", "variant": "slow", "level": "9 um" })";
  v = checked(R"("kind": "first_above", "variant": "slow", "level": "2 um")",
              "\"over\": " + never + R"(, "low": 0, "high": 1)");
  EXPECT_EQ(v.status, ClaimStatus::kNotMeasured);
  // The runs last two hours and reach 2 um after 40 min on average, so it is sooner by 1 h at
  // least.
  const std::string sooner = R"("kind": "first_above", "variant": "slow", "level": "2 um")";
  EXPECT_EQ(checked(sooner, "\"minus\": " + never + R"(, "high": "-30 min")").status,
            ClaimStatus::kHolds);
  EXPECT_EQ(checked(sooner, "\"minus\": " + never + R"(, "high": "-3 h")").status,
            ClaimStatus::kNotMeasured);
  // Other seeds, so of the means: later by 80 min at least; 3 h are not known.
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

TEST_F(Claims, FiguresAreMadeOfPlots) {
  const std::string plots = R"("plots": [ { "name": "m", "observable": "overlap_cbm_cbm_um" } ], )";
  const StudyPlan p =
      parse(text_with(plots + R"("figures": [ { "name": "f", "plots": ["m", "m"] } ])"));
  const scene_texts::TemporaryFolder folder;
  EXPECT_EQ(write_plots(p, data(), folder.path().string()),
            (std::vector<std::string>{"m.svg", "f.svg"}));
  const std::string svg = io::read_text_file(folder.path().string() + "/plots/f.svg");
  EXPECT_CONTAINS(svg, "a: m");
  EXPECT_CONTAINS(svg, "b: m");
  expect_fault(text_with(plots + R"("figures": [ { "name": "m", "plots": ["n"] } ])"),
               {"/figures/0/name", "another plot or figure", "/figures/0/plots/0", "unknown plot"});
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
  EXPECT_CONTAINS(j[0]["note"].get<std::string>(), "slow/seed_1 failed");
}

}  // namespace
}  // namespace acinus::runs
