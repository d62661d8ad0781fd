/// Warnings about a tissue beyond the limits of its model.

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

using TissueLimits = ProgramTest;

constexpr const char* kTwoCells = R"({
  "time": {"end": "1 s", "step": "1 s"},
  "cell_types": {"cell": {"adhesion": "1e-5 J/m^2", "dcm": {"cortex_young": "1 kPa", "nodes": 42}}},
  "cells": {"source": "list", "model": "dcm", "list": [
    {"position": ["0 um", "0 um", "0 um"]}, {"position": ["25 um", "0 um", "0 um"]}]},
  "motility": {"random": false}
})";

// E h = 1 kPa x 0.5 um = 5e-4 J/m^2; half of that is allowed without a word.
TEST_F(TissueLimits, AdhesionBeyondTheCortexIsAWarning) {
  write("two.json", kTwoCells);
  const auto warning = [&](const std::string& adhesion) {
    return call(run_words("two.json", "a",
                          {"--overwrite", "--set", "cell_types.cell.adhesion=" + adhesion}))
        .text;
  };
  EXPECT_FALSE(test::contains(warning("2.4e-4 J/m^2"), "warning"));
  const std::string told = warning("6e-4 J/m^2");
  for (const char* part : {"acinus: warning", "cell_types.cell.adhesion is 0.0006 J/m^2",
                           "1.2 times", "(0.00025 J/m^2)"})
    EXPECT_CONTAINS(told, part);
  EXPECT_EQ(summary("a")["warnings"].size(), 1u);
}

/// Spheres that double every 12 h in a ball for some hundred of them.
constexpr const char* kGrowsFull = R"({
  "time": {"end": "6 d", "step": "60 s"},
  "cell_types": {"cell": {"cycle": {"time": "12 h"}}},
  "cells": {"source": "clump", "model": "cbm", "count": 8},
  "capsule": {"center": ["0 um", "0 um", "0 um"], "radius": "50 um"},
  "motility": {"random": false}, "output": {"every": "12 h"}
})";

TEST_F(TissueLimits, SpheresSayThatTheirTissueIsFull) {
  write("full.json", kGrowsFull);
  const Outcome outcome = call(run_words("full.json", "a"));
  EXPECT_EQ(outcome.code, 3) << outcome.text;
  for (const char* part : {"The tissue is full", "times the volume of that space at rest",
                           "life.proliferation.cells", "inhibition"})
    EXPECT_CONTAINS(outcome.text, part);
}

}  // namespace
}  // namespace acinus::runs
