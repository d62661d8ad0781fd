/// Verdicts of `acinus compare` on runs that did not all get to the moment that is judged.

#include "runs/compare/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

class Compare : public ProgramTest {
 protected:
  Compare() { write("pair.json", kPair); }
  void run(const std::string& out, const Words& more = {}, int code = 0) {
    const Outcome made = call(run_words("pair.json", out, more));
    ASSERT_EQ(made.code, code) << made.text;
  }
  /// Every quantity that any two runs have, with a tolerance that nothing exceeds.
  Outcome compare(const std::string& a, const std::string& b, const Words& more = {}) {
    Words words{"compare", a, b};
    for (const char* name : {"cells", "positions", "density", "pressure", "cell_pressure",
                             "contact_force", "cell_force", "contacts", "cpu"})
      words.insert(words.end(), {"--tolerance", std::string(name) + "=1e9"});
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }
  void expect_not_measured(const std::string& a, const std::string& b, const std::string& why,
                           const Words& more = {}) {
    for (const Outcome& outcome : {compare(a, b, more), compare(b, a, more)}) {
      EXPECT_EQ(outcome.code, 5) << outcome.text;
      EXPECT_CONTAINS(outcome.text, "not measured: " + why);
      EXPECT_FALSE(test::contains(outcome.text, "within")) << outcome.text;
    }
  }
};

TEST_F(Compare, EqualRunsAreWithinAnyTolerance) {
  run("a");
  run("b");
  Words exact{"compare", "a", "b", "--out", "ab.json"};
  for (const char* name : {"cells", "positions", "pressure", "cell_force", "contacts"})
    exact.insert(exact.end(), {"--tolerance", std::string(name) + "=0"});
  const Outcome same = call(exact);
  EXPECT_EQ(same.code, 0) << same.text;
  EXPECT_FALSE(test::contains(same.text, "not measured")) << same.text;
  EXPECT_EQ(compare("a", "b").code, 0);
}

TEST_F(Compare, ARunThatFailedHasNoVerdict) {
  run("good");
  run("bad",
      {"--set", R"(cells.list.0.pull=["1e6 nN", "0 nN", "0 nN"])", "--set", "time.min_step=20 s"},
      3);
  expect_not_measured("good", "bad", "bad failed at ");
  const Outcome without = call({"compare", "good", "bad"});
  EXPECT_EQ(without.code, 0) << "no verdict was asked for: " << without.text;
  EXPECT_CONTAINS(without.text, "note: bad failed at ");
  const Outcome file = compare("good", "bad", {"--out", "c.json"});
  const Json verdict = json("c.json");
  EXPECT_FALSE(verdict["passes"]);
  for (const Json& row : verdict["differences"]) EXPECT_FALSE(row["passes"]) << row;
}

TEST_F(Compare, AShorterRunHasNoVerdictButAtAMomentThatBothHave) {
  run("whole");
  run("half", {"--until", "4 min"});
  expect_not_measured("whole", "half", "whole ends at 0.1333 h, but the last frame that all runs");
  const Outcome there = compare("whole", "half", {"--until", "4 min"});
  EXPECT_EQ(there.code, 0) << there.text;
  EXPECT_CONTAINS(there.text, "3 frames from 0 h to 0.06667 h");
  expect_not_measured("whole", "half", "half has frames until 0.06667 h only",
                      {"--until", "6 min"});
  expect_not_measured("whole", "half", "", {"--until", "3 min"});  // between frames
  fs::create_directories(path("stopped"));
  write("stopped/STOP", "");
  run("stopped", {}, 75);
  expect_not_measured("whole", "stopped", "stopped was stopped at ");
}

TEST_F(Compare, FramesAtOtherTimesAreTold) {
  run("a");
  run("b", {"--set", "output.every=4 min"});
  const Outcome outcome = compare("a", "b");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_CONTAINS(outcome.text,
                  "compared at 3 common times; 2 of 5 frames of a are at other times");
  run("c", {"--set", "time.end=7 min"});
  expect_not_measured("a", "c", "");
}

TEST_F(Compare, WhatTellsCellsApartNeedsTheSameCells) {
  run("two");
  run("one", {"--set", R"(cells.list=[{"position": ["0 um", "0 um", "0 um"], "model": "dcm"}])"});
  const Outcome outcome = compare("two", "one");
  EXPECT_EQ(outcome.code, 5) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "1 of 2 cells of two and 0 of 1 of one are not in the other");
  const Outcome number = call({"compare", "two", "one", "--tolerance", "cells=0.5"});
  EXPECT_EQ(number.code, 0) << "counting needs no counterpart: " << number.text;
  const Outcome density = call({"compare", "one", "one", "--tolerance", "density=1"});
  EXPECT_EQ(density.code, 5) << "of one cell there is none: " << density.text;
}

TEST(Difference, HasASignedChangeAndAnRmsOfItsOwn) {
  Comparison c;
  c.runs = {"a", "b"};
  c.drag = {{}, {}};
  const auto row = [](const char* name, double reference, double value, double judged,
                      bool is_rms) {
    return Difference{name, "Pa", reference, value, judged, false, 0.2, {}, is_rms};
  };
  c.difference = {{row("pressure", 2, 1, 0.6, true), row("force", -2, -1, 0.1, true),
                   row("cpu", 100, 3, 0.97, false), row("same", 0, 0, 0, true),
                   row("none", 0, 1, INFINITY, true)}};
  c.difference[0].push_back({"positions", "um", 0, 0.5, 0.5, true, 1.0, {}, true});
  const std::vector<Difference>& d = c.difference[0];
  EXPECT_EQ(d[0].change(), -0.5);
  EXPECT_EQ(d[0].rms(), 0.6);
  EXPECT_EQ(d[1].change(), 0.5) << "of a negative reference, upwards is positive";
  EXPECT_TRUE(std::isnan(d[2].rms()));
  EXPECT_EQ(d[3].change(), 0);
  EXPECT_TRUE(std::isinf(d[4].change()));
  EXPECT_TRUE(std::isnan(d[5].change()));
  // Verdicts are those of the judged column.
  EXPECT_FALSE(d[0].passes());
  EXPECT_TRUE(d[1].passes()) << "changed by half, but judged by its rms";
  EXPECT_FALSE(d[2].passes());
  const std::string table = comparison_table(c);
  for (const char* part : {"-50.0 %     60.0 %  BEYOND (rms at most 20 %)",
                           "+50.0 %     10.0 %  within (rms at most 20 %)",
                           "-97.0 %          -  BEYOND (change at most 20 %)", "+0.0 %      0.0 %",
                           "undefined  undefined", "-     0.5 um  within (rms at most 1 um)"})
    EXPECT_CONTAINS(table, part);
}

TEST_F(Compare, TheFileHasChangeAndRms) {
  run("a");
  run("b", {"--set", "cell_types.hepatocyte.adhesion=1e-5 J/m^2"});
  call({"compare", "a", "b", "--out", "ab.json"});
  for (const Json& row : json("ab.json")["differences"]) {
    for (const char* key : {"run", "quantity", "unit", "reference", "value", "difference",
                            "absolute", "change", "rms", "judged"})
      EXPECT_TRUE(row.contains(key)) << key;
    const Json& judged = row["judged"] == "rms" ? row["rms"] : row["change"];
    if (row["difference"].is_number())
      EXPECT_EQ(std::abs(judged.get<double>()), row["difference"].get<double>()) << row;
  }
}

TEST_F(Compare, WhatWasNotMeasuredIsNoPass) {
  run("a");
  for (const char* name : {"lesion_area", "overlap", "normal_force"}) {
    const Outcome outcome = call({"compare", "a", "a", "--tolerance", std::string(name) + "=1"});
    EXPECT_EQ(outcome.code, 5) << outcome.text;
    EXPECT_CONTAINS(outcome.text, "was not measured in every frame");
  }
  // No contact in the reference, contact here: any difference is infinite, not none.
  const std::string apart =
      R"(cells.list=[{"position": ["0 um", "0 um", "0 um"], "model": "dcm"}, {"position": ["60 um", "0 um", "0 um"], "model": "cbm"}])";
  run("apart", {"--set", apart});
  for (const char* name : {"contacts", "contact_force", "pressure", "cell_force"}) {
    const Outcome outcome =
        call({"compare", "apart", "a", "--tolerance", std::string(name) + "=100"});
    EXPECT_EQ(outcome.code, 5) << outcome.text;
    EXPECT_CONTAINS(outcome.text, "BEYOND");
  }
  const Outcome nothing = compare("apart", "apart");
  EXPECT_EQ(nothing.code, 0) << nothing.text;
}

TEST_F(Compare, FramesCloserThanASecondAreToldApart) {
  const Words fast{"--set", "time.end=400 ms",    "--set", "time.step=100 ms",
                   "--set", "output.every=100 ms"};
  run("a", fast);
  run("b", fast);
  const Outcome outcome = compare("a", "b");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "5 frames from 0 h to 0.0001111 h");
  const Comparison c = compare_runs({path("a").string(), path("b").string()}, {});
  for (const auto& row : c.difference[0])
    EXPECT_TRUE(row.difference == 0 || row.name == "cpu") << row.name;
  run("c",
      {"--set", "time.end=200 ms", "--set", "time.step=100 ms", "--set", "output.every=100 ms"});
  expect_not_measured("a", "c", "");
}

TEST_F(Compare, FoldersWithoutAFinishedRunSayWhatTheyAre) {
  run("good");
  const auto refused = [&](const std::string& folder, int code, const std::string& why) {
    for (const Words& words :
         {Words{"compare", "good", folder}, Words{"compare", folder, "good"}}) {
      const Outcome outcome = call(words);
      EXPECT_EQ(outcome.code, code) << outcome.text;
      EXPECT_CONTAINS(outcome.text, why);
    }
  };
  refused("missing", 4, "no such folder");
  fs::create_directories(path("empty"));
  refused("empty", 4, "holds no run");
  {
    const Words words{
        "run",        "pair.json", "--out", "killed run",   "--threads",          "1",
        "--progress", "json",      "--set", "time.end=9 d", "--checkpoint-every", "0.01 s"};
    Process process(folder_, words);
    ASSERT_TRUE(process.await("\"running\""));
    refused("killed run", 2, "goes on");
    while (!fs::exists(path("killed run") / "checkpoint.h5")) usleep(1000);
  }  // by SIGKILL
  refused("killed run", 2, "--resume --out 'killed run'");
  fs::remove(path("killed run") / "checkpoint.h5");
  fs::remove(path("killed run") / "checkpoint.prev.h5");
  refused("killed run", 2, "killed before its first checkpoint: ");
  // Resumed and killed: the summary is of the stop before.
  run("again", {"--until", "4 min"});
  fs::copy_file(path("again") / "summary.json", path("old.json"));
  run("again", {"--resume"});
  fs::copy_file(path("old.json"), path("again") / "summary.json",
                fs::copy_options::overwrite_existing);
  refused("again", 2, "its summary is of an earlier end");
  std::string summary = io::read_text_file((path("again") / "summary.json").string());
  const std::string status = "\"status\": \"";
  summary.insert(summary.find(status) + status.size(), "almost ");
  io::write_text_file((path("again") / "summary.json").string(), summary);
  refused("again", 2, "completed, stopped and failed are possible");
}

TEST_F(Compare, OptionsWithoutEffectAreRefused) {
  run("a");
  for (const Words& more : {Words{"--quiet"},
                            {"--threads", "1"},
                            {"--set", "seed=2"},
                            {"--runs", "x"},
                            {"--equal-drag"}}) {
    Words words{"compare", "a", "a"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(call(words).code, 2) << more[0];
  }
}

}  // namespace
}  // namespace acinus::runs
