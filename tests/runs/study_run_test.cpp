/// `acinus study` as a user calls it: on two spheres, killed, resumed, shared between processes.

#include <algorithm>
#include <random>

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Two variants with two seeds each of a pair of spheres.
constexpr const char* kPairs = R"({
  "name": "pairs",
  "scene": "two_cells",
  "set": { "cells.model": "cbm", "time.end": "20 min", "motility.random": true, "output.every": "2 min" },
  "seeds": [1, 2],
  "variants": {
    "slow": { "set": { "motility.grid": "60 s" } },
    "fast": { "set": { "motility.grid": "30 s" } }
  },
  "observables": ["overlap_cbm_cbm_um", "divisions"],
  "expectations": [
    { "id": "moves", "claim": "cells move", "low": "0 um",
      "measure": { "kind": "max", "observable": "overlap_cbm_cbm_um", "variant": "fast" } } ]
})";

/// Two cells of either model that grow, settle and are then pulled; "later" starts from "first".
constexpr const char* kShared = R"({
  "name": "shared",
  "scene": "two_cells",
  "set": { "time.end": "10 min", "time.step": "30 s", "motility.random": true, "output.every": "2 min",
           "cell_types.hepatocyte.dcm.nodes": 42, "start_up.enabled": true, "start_up.growth_time": "5 min",
           "start_up.adhesion_ramp": "2 min", "start_up.max_duration": "2 min" },
  "seeds": [1, 2],
  "variants": {
    "first": {},
    "same": { "start": "first" },
    "later": { "start": "first", "set": { "motility.grid": "120 s" } }
  },
  "observables": ["overlap_dcm_dcm_um"]
})";

class StudyProgram : public ProgramTest {
 protected:
  StudyProgram() {
    write("pairs.json", kPairs);
    write("shared.json", kShared);
  }
  static Words words(const std::string& file, const std::string& out, const Words& more = {}) {
    Words all{"study", file, "--out", out, "--jobs", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void expect_done(const Outcome& outcome) const { EXPECT_EQ(outcome.code, 0) << outcome.text; }
  void expect_same_tables(const std::string& a, const std::string& b) const {
    EXPECT_FALSE(text(a + "/table.csv").empty());
    EXPECT_TRUE(text(a + "/table.csv") == text(b + "/table.csv")) << a << " " << b;
    EXPECT_TRUE(text(a + "/table.h5") == text(b + "/table.h5")) << a << " " << b;
  }
};

bool await_file(const fs::path& file) {
  for (int look = 0; look < 3000; ++look, usleep(10'000))
    if (std::error_code code; fs::file_size(file, code) > 0 && !code) return true;
  return false;
}

/// First process that another one started.
pid_t child_of(pid_t parent) {
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) +
                         "/children");
  pid_t child = 0;
  children >> child;
  return child;
}

TEST_F(StudyProgram, TwoAtOnceWriteTheSameTableAsOne) {
  expect_done(call(words("pairs.json", "one")));
  Words two = words("pairs.json", "two");
  std::ranges::replace(two, "1", "2");
  expect_done(call(two));
  expect_same_tables("one", "two");
  // 4 runs, 2 observables, 11 frames, and the head
  EXPECT_EQ(std::ranges::count(text("one/table.csv"), '\n'), 4 * 2 * 11 + 1);
  EXPECT_FALSE(test::contains(text("one/table.csv"), "nan"));
  for (const char* file :
       {"report.md", "runs.csv", "verdicts.json", "plots/overlap_cbm_cbm_um.svg"})
    EXPECT_TRUE(fs::exists(path("one") / file)) << file;
  EXPECT_EQ(json("one/verdicts.json")[0]["pass"], true);
}

TEST_F(StudyProgram, FinishedRunsAreNotRunAgain) {
  expect_done(call(words("pairs.json", "s")));
  const Json before = summary("s/runs/slow/seed_1");
  expect_done(call(words("pairs.json", "s")));
  EXPECT_EQ(summary("s/runs/slow/seed_1"), before) << "with the same wall time";
  const Outcome list = call(words("pairs.json", "s", {"--dry-run"}));
  EXPECT_CONTAINS(list.text, "4 runs, 0 left");
  fs::remove_all(path("s/runs/fast/seed_2"));
  EXPECT_CONTAINS(call(words("pairs.json", "s", {"--dry-run"})).text, "runs of this variant");
  expect_done(call(words("pairs.json", "s", {"--only", "slow"})));
  EXPECT_FALSE(fs::exists(path("s/runs/fast/seed_2")));
}

TEST_F(StudyProgram, DescriptionsAndKeysYoungerThanARunMakeNoOtherScene) {
  expect_done(call(words("pairs.json", "s")));
  // As a run of a program without motility.directions, and of a scene with another description.
  const std::string run = "s/runs/slow/seed_1";
  Json scene = json(run + "/scene.json"), record = json(run + "/study_run.json");
  scene["description"] = "two spheres";
  ASSERT_EQ(scene["motility"].erase("directions"), 1u);
  record["identity"] = "of a scene with other texts";
  write(run + "/scene.json", scene.dump());
  write(run + "/study_run.json", record.dump());
  EXPECT_CONTAINS(call(words("pairs.json", "s", {"--dry-run"})).text, "4 runs, 0 left");
  scene["motility"]["grid"] = "61 s";
  write(run + "/scene.json", scene.dump());
  EXPECT_CONTAINS(call(words("pairs.json", "s", {"--dry-run"})).text,
                  "of another scene or version");
}

TEST_F(StudyProgram, RefusesWhatIsInTheWay) {
  write("other.json", std::string(kPairs).replace(std::string(kPairs).find("pairs"), 5, "other"));
  expect_done(call(words("pairs.json", "s", {"--only", "slow"})));
  Outcome o = call(words("other.json", "s"));
  EXPECT_EQ(o.code, 2);
  EXPECT_CONTAINS(o.text, "holds the study \"pairs\", not \"other\"");
  fs::create_directories(path("else/where"));
  o = call(words("pairs.json", "else"));
  EXPECT_EQ(o.code, 2);
  EXPECT_CONTAINS(o.text, "holds something that is no study");
  write("changed.json",
        std::string(kPairs).replace(std::string(kPairs).find("20 min"), 6, "16 min"));
  o = call(words("changed.json", "s"));
  EXPECT_EQ(o.code, 2);
  EXPECT_CONTAINS(o.text, "s/runs/slow/seed_1");
  EXPECT_CONTAINS(o.text, "--overwrite");
  expect_done(call(words("changed.json", "s", {"--overwrite"})));
  EXPECT_EQ(summary("s/runs/slow/seed_1")["simulated_s"], 960.0);
  write("typo.json", std::string(kPairs).replace(std::string(kPairs).find("\"divisions\""), 11,
                                                 "\"divisoins\""));
  o = call(words("typo.json", "new"));
  EXPECT_EQ(o.code, 2);
  EXPECT_CONTAINS(o.text, "typo.json:10:41 /observables/1 = \"divisoins\": unknown observable");
  EXPECT_FALSE(fs::exists(path("new"))) << "before anything runs";
}

TEST_F(StudyProgram, AFailedRunIsReportedAndStopsNothing) {
  std::string broken = kPairs;
  broken.replace(broken.find("\"motility.grid\": \"30 s\""), 23,
                 R"("cells.list.0.pull": ["1e6 nN", "0 nN", "0 nN"], "time.min_step": "20 s")");
  write("broken.json", broken);
  const Outcome o = call(words("broken.json", "s"));
  EXPECT_EQ(o.code, 3) << o.text;
  EXPECT_CONTAINS(o.text, "fast/seed_1 failed: ");
  EXPECT_EQ(summary("s/runs/slow/seed_2")["status"], "completed");
  EXPECT_EQ(json("s/verdicts.json")[0]["verdict"], "not measured");
  EXPECT_CONTAINS(text("s/report.md"), "| fast/seed_2 | failed |");
  EXPECT_CONTAINS(text("s/runs.csv"), "fast/seed_1,fast,1,failed");
}

TEST_F(StudyProgram, ARefusedRunIsReportedWithItsWholeCause) {
  const std::string near =
      R"([{"position": ["0 um", "0 um", "0 um"]}, {"position": ["1 um", "0 um", "0 um"]}])";
  std::string refused = kPairs;
  refused.replace(refused.find("\"motility.grid\": \"30 s\""), 23, "\"cells.list\": " + near);
  write("refused.json", refused);
  const Outcome o = call(words("refused.json", "s"));
  EXPECT_EQ(o.code, 3) << o.text;
  for (const std::string& told : {o.text, text("s/report.md"), text("s/runs.csv")}) {
    EXPECT_CONTAINS(told, "start 1 um apart");
    EXPECT_CONTAINS(told, "Move these cells");
  }
  EXPECT_CONTAINS(text("s/report.md"), "| fast/seed_1 | refused | - | ");
  EXPECT_CONTAINS(text("s/runs.csv"), "fast/seed_2,fast,2,refused,");
  EXPECT_EQ(std::ranges::count(text("s/runs.csv"), '\n'), 5) << "one line a run";
  EXPECT_CONTAINS(o.text, "2 runs done, 2 failed, 0 missing");
  EXPECT_EQ(json("s/verdicts.json")[0]["note"], "fast/seed_1 refused, fast/seed_2 refused");
  const Outcome list = call(words("refused.json", "s", {"--dry-run"}));
  EXPECT_CONTAINS(list.text, "refused");
  // It is tried again, without being asked to.
  EXPECT_CONTAINS(call(words("refused.json", "s")).text, "start 1 um apart");
}

TEST_F(StudyProgram, WhatWaitsForAStartThatFailedNamesTheFirstCause) {
  std::string shared = kShared;
  const std::string before = "\"start_up.enabled\": true";
  shared.insert(shared.find(before),
                R"("walls": [{"mirror": true, "point": ["0 um", "0 um", "2 um"]}], )");
  write("broken.json", shared);
  const Outcome o = call(words("broken.json", "s"));
  EXPECT_EQ(o.code, 3) << o.text;
  for (const std::string& told : {o.text, text("s/report.md"), text("s/runs.csv")})
    for (const char* run : {"same/seed_1", "later/seed_2"}) {
      const std::size_t at = told.find(run);
      ASSERT_NE(at, std::string::npos) << told;
      const std::string rest = told.substr(at, 400);
      EXPECT_CONTAINS(rest, "from whose start it goes on, left none: ") << told;
      EXPECT_CONTAINS(rest, "inside wall") << told;
    }
  EXPECT_FALSE(test::contains(text("s/runs.csv"), "to do")) << text("s/runs.csv");
}

TEST_F(StudyProgram, ARunThatWasKilledBeforeItsFirstCheckpointSaysSo) {
  std::string slow = kPairs;
  slow.replace(slow.find("20 min"), 6, "900 d");
  write("slow.json", slow);
  Process study(path("."),
                words("slow.json", "s", {"--only", "slow", "--checkpoint-every", "1 h"}));
  ASSERT_TRUE(await_file(path("s/runs/slow/seed_1/progress.txt")));
  kill(child_of(study.id()), SIGKILL);
  ASSERT_TRUE(study.await("slow/seed_1 failed: ended by signal 9"));
  study.send(SIGTERM);
  study.wait();
  EXPECT_CONTAINS(text("s/runs.csv"), "slow/seed_1,slow,1,killed,");
}

TEST_F(StudyProgram, OptionsWithoutEffectAreRefused) {
  expect_done(call(words("pairs.json", "s", {"--only", "slow"})));
  for (const Words& more : {Words{"--dry-run", "--overwrite"},
                            {"--dry-run", "--quiet"},
                            {"--dry-run", "--checkpoint-every", "1min"},
                            {"--tasks", "2"},
                            {"--report"}})  // with --jobs
    EXPECT_EQ(call(words("pairs.json", "s", more)).code, 2) << more[0];
  expect_done(call({"study", "pairs.json", "--out", "s", "--report"}));
}

TEST_F(StudyProgram, NamesThatAreNotUtf8AreRefusedBeforeAnythingIsMade) {
  const Outcome o = call(words("pairs.json", "s\xe4"));
  EXPECT_EQ(o.code, 2) << o.text;
  EXPECT_CONTAINS(o.text, "s?: the name is not UTF-8");
  EXPECT_FALSE(fs::exists(path("s\xe4")));
}

TEST_F(StudyProgram, TheCommandThatReportsTasksIsQuoted) {
  const Outcome o = call(words("pairs.json", "my study", {"--task", "1", "--tasks", "4"}));
  EXPECT_CONTAINS(o.text,
                  "acinus study pairs.json --out '" + path("my study").string() + "' --report");
  EXPECT_EQ(names_in("my study").size(), 2U) << "study.json and runs";
}

TEST_F(StudyProgram, KilledAndStartedAgainItWritesTheSameTable) {
  expect_done(call(words("pairs.json", "whole")));
  for (const int signal : {SIGKILL, SIGTERM}) {
    const std::string out = signal == SIGKILL ? "killed" : "stopped";
    std::mt19937 random(7);
    int left = 0;
    for (int k = 0; k < 6; ++k) {
      Process study(path("."), words("pairs.json", out));
      // Runs take a fraction of a second each, so the moments fall into all of them.
      usleep(std::uniform_int_distribution<useconds_t>(20000, 700000)(random));
      study.send(signal);
      const Outcome o = study.wait();
      if (o.code != 0) ++left;
      if (signal == SIGTERM && o.code != 0) {
        EXPECT_TRUE(o.code == 75 || o.code == -1) << o.text;
      }
    }
    EXPECT_GT(left, 0) << "none was cut short";
    expect_done(call(words("pairs.json", out)));
    expect_same_tables("whole", out);
  }
}

TEST_F(StudyProgram, StoppedWhileAnotherProcessCalibratesItStillReports) {
  setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
  write("auto.json", R"({ "name": "auto", "scene": "two_cells",
    "set": { "cells.model": "cbm", "cell_types.hepatocyte.adhesion": "2e-5 J/m^2",
      "cell_types.hepatocyte.cbm.stiffness_correction": "auto" },
    "seeds": [1], "variants": { "only": {} }, "observables": ["cells"] })");
  Process first(path("."), words("auto.json", "a"));
  ASSERT_TRUE(first.await("compressing"));
  Process study(path("."), words("auto.json", "s"));
  ASSERT_TRUE(study.await("waiting for another process"));
  study.send(SIGTERM);
  const Outcome stopped = study.wait();
  EXPECT_EQ(stopped.code, 75) << stopped.text;
  EXPECT_CONTAINS(text("s/report.md"), "| only/seed_1 | to do |");
  first.send(SIGTERM);
  EXPECT_EQ(first.wait().code, 75);
  unsetenv("XDG_CACHE_HOME");
}

TEST_F(StudyProgram, TasksShareOneFolder) {
  expect_done(call(words("pairs.json", "whole")));
  {
    Process a(path("."), words("pairs.json", "s", {"--task", "1", "--tasks", "3"}));
    Process b(path("."), words("pairs.json", "s", {"--task", "2", "--tasks", "3"}));
    expect_done(a.wait());
    expect_done(b.wait());
  }
  expect_done(call(words("pairs.json", "s", {"--task", "3", "--tasks", "3"})));
  EXPECT_FALSE(fs::exists(path("s/table.csv")));
  expect_done(call({"study", "pairs.json", "--out", "s", "--report"}));
  expect_same_tables("whole", "s");
}

TEST_F(StudyProgram, TasksWaitForTheStartsOfOneAnother) {
  expect_done(call(words("shared.json", "whole")));
  {
    Process a(path("."), words("shared.json", "s", {"--task", "1", "--tasks", "2"}));
    Process b(path("."), words("shared.json", "s", {"--task", "2", "--tasks", "2"}));
    expect_done(a.wait());
    expect_done(b.wait());
  }
  expect_done(call({"study", "shared.json", "--out", "s", "--report"}));
  expect_same_tables("whole", "s");
}

TEST_F(StudyProgram, ARunFolderIsWrittenByOneProcessOnly) {
  write("pair.json", kPair);
  Process first(path("."), {"run", "pair.json", "--out", "a", "--set", "time.end=100 days"});
  ASSERT_TRUE(first.await("thread"));
  for (const char* how : {"--overwrite", "--resume"}) {
    if (!fs::exists(path("a/checkpoint.h5")) && std::string(how) == "--resume") continue;
    const Outcome second = call({"run", "pair.json", "--out", "a", how});
    EXPECT_EQ(second.code, 2) << second.text;
    EXPECT_CONTAINS(second.text, "process " + std::to_string(first.id()) + " on ");
    EXPECT_CONTAINS(second.text, "is writing in this folder");
  }
  first.send(SIGTERM);
  EXPECT_EQ(first.wait().code, 75);
  EXPECT_EQ(summary("a")["status"], "stopped");
}

TEST_F(StudyProgram, TwoProcessesNeverRunTheSameRun) {
  expect_done(call(words("pairs.json", "whole")));
  {
    Process a(path("."), words("pairs.json", "s"));
    Process b(path("."), words("pairs.json", "s"));
    expect_done(a.wait());
    expect_done(b.wait());
  }
  expect_same_tables("whole", "s");
}

TEST_F(StudyProgram, AStudyCutShortReportsWhatIsThere) {
  expect_done(call(words("pairs.json", "s", {"--only", "slow"})));
  EXPECT_CONTAINS(text("s/table.csv"), "slow/seed_2");
  EXPECT_FALSE(test::contains(text("s/table.csv"), "fast/seed_1"));
  EXPECT_EQ(json("s/verdicts.json")[0]["verdict"], "not measured");
  EXPECT_CONTAINS(text("s/report.md"), "| fast/seed_1 | to do |");
}

TEST_F(StudyProgram, SharedStartsGiveTheSameStateAsStartUp) {
  expect_done(call(words("shared.json", "s")));
  const Json first = summary("s/runs/first/seed_1"), same = summary("s/runs/same/seed_1"),
             later = summary("s/runs/later/seed_1");
  EXPECT_EQ(same["state_hash"], first["state_hash"]);
  EXPECT_NE(later["state_hash"], first["state_hash"]);
  EXPECT_TRUE(same["start"]["from"].get<std::string>().ends_with("runs/first/seed_1"));
  EXPECT_EQ(same["start"]["state_hash"], later["start"]["state_hash"]);
  EXPECT_CONTAINS(text("s/report.md"), "- later/seed_2: cells at t = 0 of first/seed_2");
  expect_done(call(words("shared.json", "elsewhere")));
  expect_same_tables("s", "elsewhere");
  EXPECT_EQ(summary("elsewhere/runs/same/seed_1")["scene_hash"], same["scene_hash"])
      << "the hash does not depend on folders";
}

TEST_F(StudyProgram, AnyRunMayStartFromAnotherIfWhatShapesTheStartIsTheSame) {
  expect_done(call(words("shared.json", "s", {"--only", "first"})));
  fs::copy(path("s/runs/first/seed_1/scene.json"), path("here.json"));
  const Words from{"--set", "start_up.from=s/runs/first/seed_1"};
  expect_done(call(ProgramTest::run_words("here.json", "a", from)));
  EXPECT_EQ(summary("a")["state_hash"], summary("s/runs/first/seed_1")["state_hash"]);
  Words other = ProgramTest::run_words("here.json", "b", from);
  other.insert(other.end(),
               {"--set", "contact.skin=0.2 um", "--set", "friction.dcm_dcm=1e10 N s/m^3"});
  const Outcome o = call(other);
  EXPECT_EQ(o.code, 2);
  EXPECT_CONTAINS(o.text, "/contact/skin: \"0.3 um\" -> \"0.2 um\"");
  EXPECT_FALSE(test::contains(o.text, "friction")) << o.text;
  const Outcome none =
      call(ProgramTest::run_words("here.json", "c", {"--set", "start_up.from=s/runs"}));
  EXPECT_EQ(none.code, 2);
  EXPECT_CONTAINS(none.text, "no start.h5");
}

}  // namespace
}  // namespace acinus::runs
