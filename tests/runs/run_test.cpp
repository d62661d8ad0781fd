
#include <sys/resource.h>

#include <algorithm>
#include <random>

#include "core/error.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

class Run : public ProgramTest {
 protected:
  /// Runs to the end and returns the summary.
  Json finish(const Words& words, const std::string& run) const {
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return summary(run);
  }
};

TEST_F(Run, LeavesEveryFileAndEveryKeyThatScriptsRelyOn) {
  write("pair.json", kGrowing);
  const Json s = finish({"run", "pair.json", "--out", "a"}, "a");
  EXPECT_EQ(names_in("a"),
            (std::vector<std::string>{"checkpoint.h5", "run.lock", "run.log", "run.vtkhdf",
                                      "run.vtkhdf.sums", "run.xmf", "start.h5", "summary.json"}));
  for (const char* key : {"scene",
                          "scene_hash",
                          "version",
                          "git",
                          "seed",
                          "status",
                          "simulated_s",
                          "wall_s",
                          "cpu_s",
                          "peak_rss_bytes",
                          "ranks",
                          "threads",
                          "steps",
                          "cells",
                          "balance",
                          "state_hash",
                          "max_penetration_um",
                          "max_overlap_cbm_um",
                          "min_triangle_quality",
                          "skipped",
                          "timings",
                          "measures"})
    EXPECT_TRUE(s.contains(key)) << key;
  for (const char* key : {"accepted", "rejected", "solves", "cg"})
    EXPECT_TRUE(s["steps"].contains(key)) << key;
  for (const char* key : {"dcm", "cbm", "start", "end", "divisions", "deaths"})
    EXPECT_TRUE(s["cells"].contains(key)) << key;
  EXPECT_EQ(s["scene"], "pair");
  EXPECT_EQ(s["seed"], 3);
  EXPECT_EQ(s["status"], "completed");
  EXPECT_EQ(s["simulated_s"], 360.0);
  EXPECT_EQ(s["cells"]["dcm"], 2);
  EXPECT_EQ(s["cells"]["cbm"], 2);
  EXPECT_EQ(s["ranks"], 1);
  EXPECT_GT(s["steps"]["accepted"], 20);
  EXPECT_GT(s["peak_rss_bytes"], 1000000);
  EXPECT_FALSE(s["timings"].empty());
  // Pair forces are added with opposite signs from one number: round-off of sums of some 1e3 terms.
  EXPECT_LE(s["balance"]["momentum"], 1e-9);
  EXPECT_LE(s["balance"]["torque"], 1e-9);
  EXPECT_GT(s["min_triangle_quality"], 0.5);

  const io::RunReader run = reader("a");
  EXPECT_EQ(run.time_s(run.n_frame() - 1), 360.0);
  EXPECT_LT(run.time_s(0), 0) << "output.start_up";
  for (int k = 0; k < run.n_frame(); ++k) {
    const io::Frame frame = run.frame(k);
    EXPECT_EQ(frame.n_mesh_node, 84);
    EXPECT_EQ(frame.n_sphere, 2);
    EXPECT_EQ(frame.cells.ids.at(0).value.size(), 4u);
  }
  EXPECT_EQ(static_cast<int>(run.series().at("time").size()), s["steps"]["accepted"]);
  const auto provenance = run.provenance();
  for (const char* key : {"scene", "command_line", "version", "git", "compiler", "flags", "seed",
                          "ranks", "threads", "start", "end"})
    EXPECT_TRUE(provenance.contains(key)) << key;
}

/// Two cells pressed together by plates that open after 10 min.
constexpr const char* kPressed = R"({
  "name": "pressed", "experiment": "relaxation", "time": {"end": "2 h", "step": "10 min"},
  "cell_types": {"a": {"adhesion": "0 J/m^2", "dcm": {"nodes": 42}}}, "motility": {"random": false},
  "cells": {"model": "dcm", "list": [{"position": ["0 um", "0 um", "-12 um"]},
                                     {"position": ["0 um", "0 um", "12 um"]}]},
  "walls": [{"point": ["0 um", "0 um", "-24 um"], "normal": [0, 0, 1], "speed": "15 um/h",
             "travel": "2 um", "opens": "10 min", "mirror": true},
            {"point": ["0 um", "0 um", "24 um"], "normal": [0, 0, -1], "speed": "15 um/h",
             "travel": "2 um", "opens": "10 min", "mirror": true}],
  "output": {"every": "7 min", "after_opening": 2}
})";

TEST_F(Run, FollowsWhatWallsLetGoOnALogarithmicGrid) {
  write("pressed.json", kPressed);
  const Json s = finish(run_words("pressed.json", "a"), "a");
  const Json& m = s["measures"];
  const auto time = m["time_s"].get<std::vector<double>>(),
             height = m["height_um"].get<std::vector<double>>();
  for (const double t : {0.0, 420.0, 600.0, 601.0, 610.0, 700.0, 840.0, 1600.0, 7200.0})
    EXPECT_TRUE(std::ranges::any_of(time, [t](double x) { return std::abs(x - t) < 1e-5; })) << t;
  const auto released = std::ranges::find(time, 600.0, [](double t) { return std::round(t); });
  const double compressed = height[released - time.begin()];
  EXPECT_EQ(compressed, *std::ranges::min_element(height)) << "what presses is there to the end";
  EXPECT_LT(compressed, height.front() - 1);
  EXPECT_GT(height.back(), compressed + 1);
  EXPECT_GT(m["height_back_10s"][0], 0);
  EXPECT_LE(m["height_back_10s"][0], 1);
  EXPECT_GT(m["height_efold_h"][0], 0);
  EXPECT_EQ(m["relaxation_time_h"], m["height_return_h"]);
  // Stopped as they open, and gone on with: the same.
  finish(run_words("pressed.json", "parts", {"--until", "10 min"}), "parts");
  finish(run_words("pressed.json", "parts", {"--resume"}), "parts");
  expect_same("a", "parts");
  EXPECT_EQ(summary("parts")["measures"], m);
}

TEST_F(Run, DoesNotDependOnTheNumberOfThreads) {
  write("pair.json", kGrowing);
  finish(run_words("pair.json", "one", {"--threads", "1"}), "one");
  finish(run_words("pair.json", "two", {"--threads", "2"}), "two");
  expect_same("one", "two");
}

TEST_F(Run, CheckpointsAndFramesDoNotChangeIt) {
  write("pair.json", kPair);
  finish(run_words("pair.json", "plain"), "plain");
  finish(run_words("pair.json", "saved", {"--checkpoint-every", "0.001s"}), "saved");
  expect_same("plain", "saved");
  EXPECT_TRUE(fs::exists(path("saved/checkpoint.prev.h5")));
}

TEST_F(Run, ToHalfAndResumedIsTheWholeRun) {
  write("pair.json", kPair);
  finish(run_words("pair.json", "whole"), "whole");
  const Json half = finish(run_words("pair.json", "parts", {"--until", "4 min"}), "parts");
  EXPECT_EQ(half["simulated_s"], 240.0);
  EXPECT_EQ(reader("parts").n_frame(), 3);
  finish(run_words("pair.json", "parts", {"--resume"}), "parts");
  expect_same("whole", "parts");
}

// Each part of the file in turn: reported on stderr and in the summary, with the same end.
TEST_F(Run, FindsDamageToItsFileWhenItIsResumed) {
  write("pair.json", kPair);
  finish(run_words("pair.json", "whole"), "whole");
  finish(run_words("pair.json", "half", {"--until", "4 min"}), "half");
  const std::uintmax_t size = fs::file_size(path("half/run.vtkhdf"));
  for (const double place : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999}) {
    fs::remove_all(path("parts"));
    fs::copy(path("half"), path("parts"), fs::copy_options::recursive);
    {
      std::fstream file(path("parts/run.vtkhdf"), std::ios::in | std::ios::out | std::ios::binary);
      const auto at = static_cast<std::streamoff>(place * static_cast<double>(size));
      file.seekg(at);
      const int was = file.get();
      file.seekp(at);
      file.put(static_cast<char>(was ^ 4));
    }
    Words words = run_words("pair.json", "parts", {"--resume", "--quiet"});
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_CONTAINS(outcome.text, "not those that were written. Lost: ") << place;
    EXPECT_EQ(summary("parts")["warnings"].size(), 1U);
    EXPECT_EQ(summary("parts")["state_hash"], summary("whole")["state_hash"]);
    EXPECT_TRUE(fs::exists(path("parts/run.vtkhdf.damaged")));
    const io::RunReader kept = reader("parts");
    for (int k = 0; k < kept.n_frame(); ++k) kept.frame(k);
    EXPECT_GE(kept.n_frame(), 1);
  }
}

TEST_F(Run, AnEarlierEndAndResumedWithALaterOneIsTheWholeRun) {
  write("pair.json", kPair);
  finish(run_words("pair.json", "whole"), "whole");
  finish(run_words("pair.json", "parts", {"--set", "time.end=2 min"}), "parts");
  finish(run_words("pair.json", "parts", {"--resume"}), "parts");
  expect_same("whole", "parts");
}

TEST_F(Run, OneStepPerProcessIsTheWholeRun) {
  write("pair.json", kGrowing);
  finish(run_words("pair.json", "whole"), "whole");
  Words words = run_words("pair.json", "steps");
  const auto call_with_stop = [&] {
    fs::create_directories(path("steps"));
    std::ofstream(path("steps/STOP"));
    return call(words);
  };
  int starts = 1;
  Outcome outcome = call_with_stop();
  words.emplace_back("--resume");
  for (; outcome.code == 75 && starts < 500; ++starts) {
    if (starts == 1) {
      EXPECT_EQ(summary("steps")["status"], "stopped");
      EXPECT_EQ(summary("steps")["cause"], "stopped by the file STOP");
    }
    outcome = call_with_stop();
  }
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_GE(starts, summary("whole")["steps"]["accepted"]) << "a process made more than one step";
  expect_same("whole", "steps");
  RecordProperty("starts", starts);
}

TEST_F(Run, TheWallTimeLimitHoldsWhileTheSceneIsPrepared) {
  // CPU time: a busy machine may let the program wait.
  const auto cpu_of_children = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  // A lobule 30 cm high: most of a minute of work.
  const Words scene{"lobule_hybrid", "--set", "lobule.height=3e5 um", "--max-walltime", "1s"};
  for (Words words : {Words{"run", "--threads", "1", "--out", "p"}, Words{"check"}}) {
    words.insert(words.end(), scene.begin(), scene.end());
    const double before = cpu_of_children();
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 75) << outcome.text;
    EXPECT_CONTAINS(outcome.text, "stopped by the wall-time limit");
    EXPECT_LT(cpu_of_children() - before, 5);  // s
  }
  EXPECT_FALSE(fs::exists(path("p")));
}

TEST_F(Run, StopsOnSignalsAndOnTheStopFileAndGoesOn) {
  write("pair.json", kPair);
  const Words often{"--set", "time.end=16 min", "--set", "output.every=30 s"};
  finish(run_words("pair.json", "whole", often), "whole");
  for (const int signal : {SIGTERM, SIGUSR1, SIGINT}) {
    const std::string run = "signal" + std::to_string(signal);
    Words words{"run", "pair.json", "--out", run, "--progress", "json", "--threads", "1"};
    words.insert(words.end(), often.begin(), often.end());
    Process process(folder_, words);
    ASSERT_TRUE(process.await("\"running\"")) << "handlers are set before the first step";
    process.send(signal);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.code, 75) << outcome.text;
    EXPECT_EQ(summary(run)["status"], "stopped");
    EXPECT_LT(summary(run)["simulated_s"], 960);

    Words again{"run", "pair.json", "--resume", "--out", run, "--threads", "1"};
    again.insert(again.end(), often.begin(), often.end());
    write(run + "/STOP", "");
    const Outcome stopped = call(again);
    EXPECT_EQ(stopped.code, 75) << stopped.text;
    EXPECT_CONTAINS(stopped.text, "continue with: acinus run pair.json --resume --out " + run +
                                      " --set 'time.end=16 min'");
    EXPECT_FALSE(fs::exists(path(run + "/STOP"))) << "obeyed once";
    const Outcome last = call(again);
    EXPECT_EQ(last.code, 0) << last.text;
    expect_same("whole", run);
  }
}

TEST_F(Run, KilledAtAnyMomentKeepsItsFinishedFrames) {
  write("pair.json", kPair);
  const Words often{"--set", "output.every=30 s", "--checkpoint-every", "0.03s"};
  finish(run_words("pair.json", "whole", often), "whole");
  const std::vector<io::Frame> whole = read_frames(reader("whole"));
  const double wall = summary("whole")["wall_s"];
  const std::string hash = summary("whole")["state_hash"];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0.05, 1.1);
  int killed = 0, resumed = 0;
  std::size_t frames = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::string run = "trial" + std::to_string(trial), what = run;
    Words words = run_words("pair.json", run, often);
    {
      Process process(folder_, words);
      usleep(static_cast<useconds_t>(1e6 * wall * moment(random)));  // the random moment itself
      process.send(SIGKILL);
      if (process.wait().code == -1) ++killed;
    }
    const bool saved = fs::exists(path(run) / "checkpoint.h5");
    if (saved) {
      const std::vector<io::Frame> part = read_frames(reader(run));
      expect_first_frames(part, whole, what);
      frames += part.size();
      ++resumed;
    } else if (fs::exists(path(run) / "run.vtkhdf")) {
      // Killed before the first checkpoint: the file may not be made yet, but what is in it is
      // right.
      try {
        const std::vector<io::Frame> part = read_frames(reader(run));
        expect_first_frames(part, whole, what);
        frames += part.size();
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Exit::kFileError) << error.what();
      }
    }
    words.emplace_back(saved ? "--resume" : "--overwrite");
    EXPECT_EQ(finish(words, run)["state_hash"], hash) << what;
    const std::vector<io::Frame> all = read_frames(reader(run));
    EXPECT_EQ(all.size(), whole.size()) << what;
    expect_first_frames(all, whole, what);
    fs::remove_all(path(run));
  }
  std::printf("killed %d of 20, %zu finished frames read, %d resumed from a checkpoint\n", killed,
              frames, resumed);
  EXPECT_GE(killed, 10);
  EXPECT_GE(resumed, 5);
}

}  // namespace
}  // namespace acinus::runs
