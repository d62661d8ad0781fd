/// Scenes whose cells overlap deeply at t = 0, and the messages about it.

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

using StartOverlap = ProgramTest;

/// Clump of cells anywhere in their cycle, so up to a quarter wider than their places.
constexpr const char* kAnyAge = R"({
  "time": {"end": "1 min", "step": "30 s"},
  "cell_types": {"tumour": {"dcm": {"nodes": 42}, "cycle": {"time": "24 h", "start": "random"}}},
  "cells": {"source": "clump", "model": "dcm", "count": 9},
  "start_up": {"growth_time": "5 min", "adhesion_ramp": "2 min", "max_duration": "2 min"},
  "motility": {"random": false}, "output": {"every": "1 min"}
})";

TEST_F(StartOverlap, IsAWarningWithAdviceThatWorks) {
  write("any_age.json", kAnyAge);
  const Outcome outcome = call(run_words("any_age.json", "a"));
  EXPECT_CONTAINS(outcome.text, "acinus: warning") << "also with --quiet";
  for (const std::string& told :
       {outcome.text, text("a/run.log"), summary("a")["warnings"].dump()}) {
    for (const char* part :
         {"starts with overlaps: ", "start_up.enabled", "cycle.start = birth", "cells.spacing"})
      EXPECT_CONTAINS(told, part);
    EXPECT_FALSE(test::contains(told, "cells.count"))
        << "fewer cells of a clump are no farther apart\n"
        << told;
  }
  for (const char* advice :
       {"start_up.enabled=true", "cell_types.tumour.cycle.start=birth", "cells.spacing=1.26"}) {
    const Outcome better = call(run_words("any_age.json", "b", {"--overwrite", "--set", advice}));
    EXPECT_EQ(better.code, 0) << advice << "\n" << better.text;
    EXPECT_FALSE(test::contains(better.text, "warning")) << advice << "\n" << better.text;
  }
}

TEST_F(StartOverlap, PhasesOfAStartUpMayHaveNoLength) {
  write("any_age.json", kAnyAge);
  const auto start = [&](const Words& changes) {
    Words more{"--overwrite", "--set", "start_up.enabled=true"};
    for (const std::string& change : changes) more.insert(more.end(), {"--set", change});
    Words words = run_words("any_age.json", "b", more);
    std::erase(words, "--quiet");
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return outcome.text;
  };
  EXPECT_CONTAINS(start({"start_up.adhesion_ramp=0 min"}), "full adhesion after 0.08 h");
  EXPECT_CONTAINS(start({"start_up.max_duration=0 h"}), "t = 0 after 0.12 h of start-up, without");
  EXPECT_CONTAINS(start({"start_up.adhesion_ramp=0 min", "start_up.max_duration=0 h"}),
                  "t = 0 after 0.08 h of start-up, without settling");
}

/// Deformable cells whose centres may be 0.6 diameters apart.
constexpr const char* kFilled = R"({
  "time": {"end": "30 s", "step": "30 s"},
  "cell_types": {"hepatocyte": {"dcm": {"nodes": 42}}},
  "cells": {"source": "fill", "model": "dcm", "count": 6, "min_distance": "14.4 um",
            "low": ["0 um", "0 um", "0 um"], "high": ["20 um", "20 um", "20 um"]},
  "motility": {"random": false}, "output": {"every": "30 s"}
})";

TEST_F(StartOverlap, AdviceFollowsHowCellsArePlaced) {
  write("filled.json", kFilled);
  const Outcome outcome = call(run_words("filled.json", "a"));
  EXPECT_CONTAINS(outcome.text, "cells.count, cells.min_distance");
  EXPECT_FALSE(test::contains(outcome.text, "cycle.start")) << outcome.text;
  for (const Words& advice : {Words{"--set", "cells.count=2", "--set", "cells.min_distance=22 um"},
                              Words{"--set", "cell_types.hepatocyte.radius=7 um"}}) {
    Words words = run_words("filled.json", "b", advice);
    words.emplace_back("--overwrite");
    const Outcome better = call(words);
    EXPECT_EQ(better.code, 0) << better.text;
    EXPECT_FALSE(test::contains(better.text, "warning")) << advice[1] << "\n" << better.text;
  }
}

}  // namespace
}  // namespace acinus::runs
