/// Runs of cells with a nucleus: what they write, that they go on, and that one without any
/// stiffness changes nothing.

#include <gtest/gtest.h>

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Cell between two plates that close, or a spheroid that divides, with all of the inside on.
constexpr const char* kBetweenPlates = R"({
  "model": "dcm", "experiment": "plates",
  "time": {"end": "60 min", "step": "30 s", "tolerance": "0.05 um"},
  "cell_types": {"cell": {"dcm": {"nodes": 162, "nucleus": NUCLEUS}}},
  "cells": {"list": [{"position": ["0 um", "0 um", "0 um"]}]},
  "motility": {"random": false},
  "walls": [{"point": ["0 um", "0 um", "-12 um"], "normal": [0, 0, 1], "mirror": true},
            {"point": ["0 um", "0 um", "12 um"], "normal": [0, 0, -1], "speed": "12 um/h",
             "travel": "10 um", "mirror": true}],
  "output": {"every": "10 min"}
})";

constexpr const char* kGrowingNuclei = R"({
  "seed": 5,
  "model": "dcm",
  "time": {"end": "320 min", "step": "2 min", "tolerance": "0.05 um"},
  "solver": {"tolerance": 0.02},
  "cell_types": {"tumour": {"dcm": {"nodes": 42, "cortex_tension": "2e-4 N/m",
      "nucleus": {"link_young": "0.1 kPa", "link_friction": "10 Pa s"},
      "contraction": {"ring": 1, "course": [{"time": "0 s", "factor": 0.5},
                                            {"time": "200 min", "factor": 1.5}]}},
    "adhesion": "1e-5 J/m^2", "cycle": {"time": "2 h", "spread": 0.1, "mitosis": "40 min"},
    "death": {"mode": "lysis", "duration": "30 min"}}},
  "cells": {"list": [{"position": ["0 um", "0 um", "0 um"]}]},
  "life": {"rules": [{"do": "die", "share": 0.7, "from": "260 min"}]},
  "contact": {"quadrature": "nodes"},
  "motility": {"random": true, "grid": "10 min"},
  "output": {"every": "20 min"}
})";

class NucleusRun : public ProgramTest {
 protected:
  Json finish(const std::string& scene, const std::string& out, const Words& more = {}) const {
    const Outcome outcome = call(run_words(scene, out, more));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return summary(out);
  }
  std::string pressed(const std::string& name, const std::string& nucleus) const {
    std::string text = kBetweenPlates;
    text.replace(text.find("NUCLEUS"), 7, nucleus);
    write(name + ".json", text);
    return name + ".json";
  }
};

TEST_F(NucleusRun, WithoutAnyStiffnessChangesNoBit) {
  const Json none = finish(pressed("none", "null"), "none");
  const Json limp =
      finish(pressed("limp", R"({"young": "0 kPa", "bulk_modulus": "0 Pa"})"), "limp");
  EXPECT_EQ(limp["state_hash"], none["state_hash"]);
  EXPECT_EQ(limp["steps"], none["steps"]);
  EXPECT_EQ(limp["measures"], none["measures"]);
}

TEST_F(NucleusRun, WritesNucleiAsAKindOfTheirOwn) {
  finish(pressed("cell", R"({"size": 0.7})"), "cell");
  const io::RunReader run = reader("cell");
  ASSERT_GT(run.n_frame(), 1);
  const io::Frame frame = run.frame(run.n_frame() - 1);
  int cortex = 0, nucleus = 0;
  for (std::size_t k = 0; k < frame.kind.size(); ++k) {
    cortex += frame.kind[k] == 0 ? 1 : 0;
    nucleus += frame.kind[k] == 3 ? 1 : 0;
    EXPECT_EQ(frame.cell_id[k], 0) << "both belong to the cell";
  }
  EXPECT_EQ(cortex, 320);
  EXPECT_EQ(nucleus, 80);
  EXPECT_EQ(frame.n_mesh_node, 162 + 42);
}

// The plates leave 14 um between them where the nucleus is 16.8 um wide and keeps 0.3 um off.
TEST_F(NucleusRun, BearsPartOfTheLoadAsItIsStiff) {
  const auto force = [&](const std::string& name, const std::string& nucleus) {
    const Json found = finish(pressed(name, nucleus), name)["measures"]["force_nN"];
    return found.back().get<double>();
  };
  const double none = force("none", "null"),
               soft = force("soft", R"({"size": 0.7, "young": "1 kPa", "bulk_modulus": "1 kPa"})"),
               stiff = force("stiff", R"({"size": 0.7})");
  std::printf("force on a plate: %.3f nN, with a nucleus of 1 kPa %.3f, of 5 kPa %.3f\n", none,
              soft, stiff);
  EXPECT_GT(soft, 1.05 * none);
  EXPECT_GT(stiff, 1.05 * soft);
}

TEST_F(NucleusRun, ThroughDivisionsAndDeathIsBitForBit) {
  write("growing.json", kGrowingNuclei);
  const Json whole = finish("growing.json", "whole");
  std::printf("%s\n", whole["cells"].dump().c_str());
  EXPECT_GE(whole["cells"]["divisions"], 3);
  EXPECT_GE(whole["cells"]["deaths"], 1);
  finish("growing.json", "parts", {"--until", "100 min"});
  finish("growing.json", "parts", {"--resume", "--until", "140 min"});
  finish("growing.json", "parts", {"--resume", "--until", "260 min"});
  const Json parts = finish("growing.json", "parts", {"--resume"});
  EXPECT_EQ(parts["state_hash"], whole["state_hash"]);
  EXPECT_EQ(parts["steps"], whole["steps"]);
  const io::RunReader x = reader("whole"), y = reader("parts");
  EXPECT_EQ(x.n_frame(), y.n_frame());
  expect_first_frames(read_frames(x), read_frames(y), "parts");
}

TEST_F(NucleusRun, SpheresHaveNone) {
  const std::string with = pressed("with", "{}"), without = pressed("without", "null");
  const Json a = finish(with, "with", {"--set", "model=cbm", "--set", "experiment=free"});
  const Json b = finish(without, "without", {"--set", "model=cbm", "--set", "experiment=free"});
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
}

}  // namespace
}  // namespace acinus::runs
