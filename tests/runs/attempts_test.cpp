/// Times per stage over the attempts of a resumed run.

#include "runs/session/attempts.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

Timings two_stages() {
  Timings timings;
  { const auto solve = timings.scope("solve"); }
  { const auto audit = timings.scope("frames and audit"); }
  return timings;
}

TEST(Attempts, AddUpStageByStage) {
  const Timings timings = two_stages();
  const Attempts before{2, {{"solve", 3.0, 4.0, 5}, {"zoom", 1.0, 1.0, 1}}};
  const Attempts sum = add_attempt(before, timings);
  EXPECT_EQ(sum.count, 3);
  ASSERT_EQ(sum.stages.size(), 3u);
  EXPECT_EQ(sum.stages[0].name, "solve");
  EXPECT_DOUBLE_EQ(sum.stages[0].wall, 3.0 + timings.stage("solve").wall);
  EXPECT_DOUBLE_EQ(sum.stages[0].cpu, 4.0 + timings.stage("solve").cpu);
  EXPECT_EQ(sum.stages[0].calls, 6u);
  EXPECT_EQ(sum.stages[1].wall, 1.0) << "a stage that did not run again";
  EXPECT_EQ(sum.stages[2].name, "frames and audit");
}

TEST(Attempts, AreKeptByCheckpoints) {
  io::CheckpointData data;
  put_attempts({2, {{"frames and audit", 3.0, 4.0, 5}}}, data);
  const Attempts read = get_attempts(data);
  EXPECT_EQ(read.count, 2);
  ASSERT_EQ(read.stages.size(), 1u);
  EXPECT_EQ(read.stages[0].name, "frames and audit");
  EXPECT_EQ(read.stages[0].wall, 3.0);
  EXPECT_EQ(read.stages[0].cpu, 4.0);
  EXPECT_EQ(read.stages[0].calls, 5u);
  EXPECT_EQ(get_attempts(io::CheckpointData{}).count, 0) << "of a version that did not count them";
}

TEST(Attempts, WithoutTheTimesOfAStageAreRefused) {
  io::CheckpointData data;
  data.put_count("attempts/count", 1);
  data.put("attempts/stages", "solve\nlife\n");
  data.put("attempts/wall_s", std::vector<double>{1.0});
  data.put("attempts/cpu_s", std::vector<double>{1.0});
  data.put("attempts/calls", std::vector<std::uint64_t>{1});
  EXPECT_THROW(get_attempts(data), Error);
}

class AttemptsOfRuns : public ProgramTest {};

TEST_F(AttemptsOfRuns, AreSummedAndTheLastIsShown) {
  write("pair.json", R"({"name": "pair", "time": {"end": "2 h"},
    "cell_types": {"a": {"dcm": {"nodes": 42}}}, "cells": {"source": "clump", "count": 2}})");
  ASSERT_EQ(call(run_words("pair.json", "a", {"--until", "1 h"})).code, 0);
  const Json first = summary("a");
  EXPECT_EQ(first["attempts"], 1);
  EXPECT_EQ(first["timings"], first["timings_last_attempt"]);
  const Outcome again = call(run_words("pair.json", "a", {"--resume", "--timings"}));
  ASSERT_EQ(again.code, 0) << again.text;
  EXPECT_CONTAINS(again.text, "all 2 attempts:");
  const Json s = summary("a");
  EXPECT_EQ(s["attempts"], 2);
  const double before = first["timings"]["solve"], last = s["timings_last_attempt"]["solve"];
  EXPECT_GT(last, 0);
  EXPECT_NEAR(s["timings"]["solve"], before + last, 1e-9);
}

}  // namespace
}  // namespace acinus::runs
