/// Lines that a run prints for a person.

#include <regex>

#include "runs/session/idle_rules.hpp"
#include "runs/session/result_text.hpp"
#include "tests/coupling/worlds.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Lines of a text that begin with a word.
std::vector<std::string> lines_with(const std::string& text, const std::string& start) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(start)) lines.push_back(line);
  return lines;
}

class TerminalOutput : public ProgramTest {
 protected:
  TerminalOutput() { write("pair.json", kPair); }

  /// Output of a run of `scene`, which must end with `code`.
  std::string run(const Words& more, const std::string& scene = "pair.json", int code = 0) const {
    Words words{"run", scene, "--out", "a", "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, code) << outcome.text;
    return outcome.text;
  }
  /// Lines of the log without their dates.
  std::string log() const { return text("a/run.log"); }
};

/// Percent and simulated minutes of the first progress line.
struct FirstLine {
  int percent = -1;
  double minutes = -1;
  std::string rest;
};

FirstLine first_progress(const std::string& text, const std::string& phase) {
  const std::regex form("(?:^|\n)" + phase + R"( (\d+) %  ([0-9.]+) (s|min) of ([^\n]*))");
  std::smatch found;
  if (!std::regex_search(text, found, form)) {
    ADD_FAILURE() << "no progress line of \"" << phase << "\" in\n" << text;
    return {};
  }
  return {std::stoi(found[1]), std::stod(found[2]) / (found[3] == "s" ? 60 : 1), found[4]};
}

/// Expects the percent of a duration (min) that belongs to the time shown, which is rounded to 0.1.
void expect_percent(const FirstLine& line, double duration) {
  constexpr double kRounding = 0.05;
  EXPECT_GE(line.percent, std::floor(100 * (line.minutes - kRounding) / duration));
  EXPECT_LE(line.percent, std::floor(100 * (line.minutes + kRounding) / duration));
}

TEST_F(TerminalOutput, ProgressLinesSayHowMuchIsDone) {
  const FirstLine start = first_progress(run({"--until", "4 min"}), "running");
  EXPECT_EQ(start.rest, "4.0 min  1 deformable cell, 1 sphere");
  expect_percent(start, 4);
  const FirstLine second = first_progress(run({"--resume"}), "running");
  EXPECT_EQ(second.rest, "8.0 min  1 deformable cell, 1 sphere");
  EXPECT_GT(second.minutes, 4);
  expect_percent(second, 8);
}

TEST_F(TerminalOutput, PercentOfStartUpIsThatOfItsPhase) {
  write("growing.json", kGrowing);
  const FirstLine growing = first_progress(run({}, "growing.json"), "start-up: growing");
  expect_percent(growing, 5);
  EXPECT_EQ(growing.rest, "at most 9.0 min  2 deformable cells, 2 spheres");
}

TEST_F(TerminalOutput, DetailsAreForVerboseRunsAndTheLog) {
  const std::string details[] = {"skipped: ", "also skipped: "};
  const std::string plain = run({});
  for (const std::string& detail : details) {
    EXPECT_EQ(plain.find(detail), std::string::npos) << plain;
    EXPECT_CONTAINS(log(), detail);
  }
  EXPECT_EQ(plain.find("real time"), std::string::npos);
  const std::string verbose = run({"--verbose", "--overwrite"});
  for (const std::string& detail : details)
    EXPECT_EQ(lines_with(verbose, detail).size(), 1U) << verbose;
  EXPECT_TRUE(std::regex_search(first_progress(verbose, "running").rest,
                                std::regex(R"(  dt [0-9.]+ s  \d+x real time)")))
      << verbose;
  EXPECT_CONTAINS(run({"--verbose", "--quiet", "--overwrite"}, "pair.json", 2), "excludes");
}

TEST_F(TerminalOutput, TheEndSaysWhatTheRunLeaves) {
  const std::string end = run({});
  const std::size_t completed = end.find("\ncompleted 8.0 min in ");
  ASSERT_NE(completed, std::string::npos) << end;
  EXPECT_CONTAINS(end.substr(completed),
                  "; results in a\ncells: 1 deformable cell, 1 sphere\n"
                  "deepest overlap of deformable cells with ... "
                  "deepest overlap of spheres: 0 um, 0 % of a radius: good "
                  "(limit 50 %)\n ... "
                  "page for the browser: acinus report a\n"
                  "ParaView 5.12 or newer: a/run.vtkhdf");
  EXPECT_EQ(lines_with(end, "cells: ").size(), 1U);
  // Quiet runs and JSON print nothing of this.
  EXPECT_EQ(run({"--quiet", "--overwrite"}), "");
  EXPECT_EQ(run({"--progress", "json", "--overwrite"}).find("deepest"), std::string::npos);
}

TEST_F(TerminalOutput, AStoppedRunSaysHowFarItCame) {
  fs::create_directories(path("a"));
  write("a/STOP", "");
  const std::string text = run({"--set", "time.step=30 s"}, "pair.json", 75);
  const std::vector<std::string> stopped = lines_with(text, "stopped by ");
  ASSERT_EQ(stopped.size(), 1U) << text;
  EXPECT_TRUE(std::regex_search(
      stopped[0],
      std::regex(R"(^stopped by the file STOP at [0-9.]+ s of 8\.0 min; continue with: )")))
      << stopped[0];
  EXPECT_EQ(text.find("completed"), std::string::npos);
  EXPECT_EQ(text.find("deepest"), std::string::npos);
}

TEST_F(TerminalOutput, RulesThatBeginTooLateAreNoted) {
  const Words late{
      "--set", R"(life.rules=[{"do": "rest", "from": "8 min"}, {"do": "die", "from": "7 min"}])",
      "--set", "life.grid=1 min"};
  Words check{"check", "pair.json"};
  check.insert(check.end(), late.begin(), late.end());
  const std::string note =
      "life.rules.0 never acts: it begins at 0.1333 h, and the scene ends at 0.1333 h\n";
  const std::string checked = call(check).text, text = run(late);
  EXPECT_CONTAINS(checked, note);
  EXPECT_EQ(checked.find("life.rules.1"), std::string::npos);
  EXPECT_EQ(lines_with(text, "life.rules.0").size(), 1U) << "once, not at the end again: " << text;
  EXPECT_EQ(lines_with(text, "life.rules.1").size(), 0U) << "it kills: " << text;
}

TEST_F(TerminalOutput, RulesThatNeverActedAreNotedAtTheEnd) {
  const std::string rules = R"(life.rules=[{"do": "die", "region": {"kind": "sphere",)"
                            R"( "center": ["0 um", "0 um", "1 mm"], "radius": "1 um"}}])";
  const std::string text = run({"--set", rules});
  EXPECT_EQ(lines_with(text, "life.rules.0 never acted: no cell died").size(), 1U) << text;
  EXPECT_CONTAINS(summary("a")["notes"].dump(), "life.rules.0 never acted");
}

TEST_F(TerminalOutput, LeadersWithoutVeinAreReported) {
  const std::string warning = "motility.leader_force pulls the leading cells toward the vertical";
  EXPECT_CONTAINS(call({"check", "pair.json", "--set", "motility.leader_force=0.1 nN"}).text,
                  warning);
  EXPECT_EQ(call({"check", "pair.json"}).text.find(warning), std::string::npos);
  EXPECT_EQ(call({"check", "lobule_hybrid"}).text.find(warning), std::string::npos);
}

/// Scene with inhibition by pressure and two rules, and a state without cells.
struct IdleRules : testing::Test {
  IdleRules() {
    scene.cell_types["a"].cycle.inhibition = {.by = coupling::InhibitedBy::kPressure,
                                              .threshold = 5};
    scene.life.rules.resize(2);
    scene.life.rules[0].die = true;
    scene.life.rules[1].die = false;
    measures["contact_pressure_max_dcm_Pa"] = {0.1, 0.63, 0.2};
    measures["slowest_growth"] = {1, 0.999, 1};
    measures["resting_cells"] = {0, 0, 0};
  }
  std::vector<std::string> list(double time = 100) const {
    return list_idle_rules(scene, measures, world, time);
  }
  Scene scene;
  Measures measures;
  coupling::World world;
};

TEST_F(IdleRules, AreAllListedWithTheirReason) {
  const std::vector<std::string> all = list();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0],
            "cell_types.a: inhibition by pressure at 5000 Pa never slowed growth (highest contact "
            "pressure 0.63 Pa)");
  EXPECT_EQ(all[1], "life.rules.0 never acted: no cell died");
  EXPECT_EQ(all[2], "life.rules.1 never acted: no cell rested in any frame");
}

TEST_F(IdleRules, AreNotThoseThatActed) {
  measures["slowest_growth"] = {1, 0.98, 1};
  EXPECT_EQ(list().size(), 2U) << "growth was slowed by 2 %";
  world.state.deaths = 1;
  EXPECT_EQ(list().size(), 1U);
  measures["resting_cells"] = {0, 3, 0};
  EXPECT_TRUE(list().empty());
}

TEST_F(IdleRules, AreNotThoseThatBeginLater) {
  for (LifeRuleBlock& rule : scene.life.rules) rule.from = 100;
  EXPECT_EQ(list(100).size(), 1U) << "inhibition only";
  EXPECT_EQ(list(100.1).size(), 3U);
}

TEST_F(IdleRules, ACellThatDiesIsEnough) {
  world.state.cycle.assign(2, {});
  world.state.cycle[1].fate = coupling::Fate::kLyse;
  EXPECT_EQ(list().size(), 2U);
}

TEST_F(IdleRules, NoneAreListedWithoutRules) {
  scene = {};
  EXPECT_TRUE(list().empty());
}

TEST(ResultText, CountsCellsByModel) {
  EXPECT_EQ(describe_cells(1, 0), "1 deformable cell");
  EXPECT_EQ(describe_cells(0, 1), "1 sphere");
  EXPECT_EQ(describe_cells(13, 2), "13 deformable cells, 2 spheres");
  EXPECT_EQ(describe_cells(0, 0), "0 deformable cells");
}

TEST(ResultText, DurationsHaveAUnitThatSuitsThem) {
  EXPECT_EQ(format_duration(0.44), "0.4 s");
  EXPECT_EQ(format_duration(45), "45 s");
  EXPECT_EQ(format_duration(600), "10.0 min");
  EXPECT_EQ(format_duration(72000), "20.0 h");
}

TEST(ResultText, JudgesTheDeepestOverlapOfEachModel) {
  const coupling::World w = coupling::make_test_world(
      {{Vec3::Zero(), true}, {Vec3(30, 0, 0), false}, {Vec3(54, 0, 0), false}});
  RunTotals t;
  t.max_penetration_um = 0.5 * w.params.dcm_contact.max_depth;
  t.max_overlap_cbm_um = 3;
  t.cbm_vessel_um = 1.5;
  std::vector<std::string> good = describe_result(w, t, 3);
  ASSERT_EQ(good.size(), 4U);
  EXPECT_EQ(good[0], "cells: 1 deformable cell, 2 spheres");
  EXPECT_EQ(good[2], "deepest overlap of spheres: 3 um, 25 % of a radius: good (limit 50 %)");
  EXPECT_EQ(good[3],
            "deepest overlap of spheres and vessels: 1.5 um, 12 % of a radius: good (limit 40 %)");
  for (const std::string& line : good) EXPECT_EQ(line.find("TOO DEEP"), std::string::npos) << line;
  t.max_penetration_um = 1.1 * w.params.dcm_contact.max_depth;
  t.max_overlap_cbm_um = 6.1;
  t.cbm_vessel_um = 4.9;
  const std::vector<std::string> deep = describe_result(w, t, 3);
  ASSERT_EQ(deep.size(), 5U);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_CONTAINS(deep[k], ": TOO DEEP (limit ");
  EXPECT_CONTAINS(deep[4], "their forces are not those of deformable cells");
}

TEST(ResultText, TellsMeanPressuresOfTheModelsThatAreThere) {
  const std::vector<std::string> lines =
      describe_pressures({{"cells_dcm", {2, 3}},
                          {"cells_cbm", {1, 0}},
                          {"cytosol_pressure_mean_dcm_Pa", {4, 5.25}},
                          {"contact_pressure_mean_dcm_Pa", {9, 0.125}}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            "mean pressure of the deformable cells at the end: 5.25 Pa in the cytosol, 0.125 Pa at "
            "contacts");
  EXPECT_TRUE(describe_pressures({}).empty());
}

TEST(ResultText, DaughtersThatStartDeepHaveNoVerdict) {
  coupling::World w = coupling::make_test_world({{Vec3::Zero(), false}, {Vec3(22, 0, 0), false}});
  w.state.divisions = 1;
  RunTotals t;
  t.max_overlap_cbm_um = 11;
  const std::vector<std::string> lines = describe_result(w, t, 1);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "cells: 2 spheres (1 at the start, 1 division, 0 deaths)");
  EXPECT_CONTAINS(lines[1], "no verdict");
}

}  // namespace
}  // namespace acinus::runs
