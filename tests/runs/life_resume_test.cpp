/// Runs with divisions that were stopped and resumed are those that were not, bit for bit.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Spheroid whose cells divide every two hours: 42 nodes, random motility, some cells asleep.
constexpr const char* kSpheroid = R"({
  "seed": 5,
  "model": "dcm",
  "experiment": "spheroid",
  "time": {"end": "320 min", "step": "2 min", "tolerance": "0.05 um"},
  "solver": {"tolerance": 0.02},
  "cell_types": {"tumour": {"dcm": {"nodes": 42}, "adhesion": "1e-5 J/m^2",
    "cycle": {"time": "2 h", "spread": 0.1, "mitosis": "40 min"}}},
  "cells": {"source": "list", "list": [{"position": ["0 um", "0 um", "0 um"]}]},
  "contact": {"quadrature": "nodes"},
  "motility": {"random": true, "grid": "10 min"},
  "output": {"every": "20 min"}
})";

class LifeResume : public ProgramTest {
 protected:
  Json finish(const std::string& out, const std::string& model, Words more) const {
    more.insert(more.end(), {"--set", "model=" + model});
    const Outcome outcome = call(run_words("spheroid.json", out, more));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return summary(out);
  }
};

TEST_F(LifeResume, ThroughDivisionsIsBitForBitInBothModels) {
  write("spheroid.json", kSpheroid);
  for (const std::string model : {"dcm", "cbm"}) {
    const std::string whole = model + "_whole", parts = model + "_parts";
    const Json end = finish(whole, model, {});
    std::printf("%s: %d divisions\n", model.c_str(), end["cells"]["divisions"].get<int>());
    EXPECT_GE(end["cells"]["divisions"], 3);
    finish(parts, model, {"--until", "100 min"});              // before the first division
    finish(parts, model, {"--resume", "--until", "140 min"});  // near it: mitosis, or forces rise
    finish(parts, model, {"--resume", "--until", "260 min"});
    finish(parts, model, {"--resume"});
    expect_same(whole, parts);
  }
}

TEST_F(LifeResume, IsBitForBitThroughChangesOfModel) {
  write("spheroid.json", kSpheroid);
  const Words more{"--set", R"(zoom=[{"kind": "pressure", "above": "0.4 Pa", "below": "0.1 Pa"}])",
                   "--set", R"(moving_zoom={"every": "20 min", "stay": "20 min"})"};
  finish("whole", "zoom", more);
  std::map<std::string, int> events;
  for (const auto& e : reader("whole").events()) ++events[e.code];
  std::printf("%d promotions, %d demotions\n", events["promotion"], events["demotion"]);
  EXPECT_GE(events["promotion"], 2);
  EXPECT_GE(events["demotion"], 1);
  Words part = more;
  part.insert(part.end(), {"--until", "140 min"});
  finish("parts", "zoom", part);
  for (const std::string until : {"180 min", "240 min", "260 min", "320 min"}) {
    part = more;
    part.insert(part.end(), {"--resume", "--until", until});
    finish("parts", "zoom", part);
  }
  expect_same("whole", "parts");
}

TEST_F(LifeResume, IsBitForBitBesideVesselsThatBend) {
  write("spheroid.json", kSpheroid);
  write("vessel.swc", "1 0 -60 0 -16 4 -1\n2 0 0 0 -16 4 1\n3 0 60 10 -16 4 2\n4 0 0 60 -22 3 2\n");
  for (const std::string model : {"dcm", "zoom"}) {
    const Words more{"--set",
                     "vessels.file=vessel.swc",
                     "--set",
                     "vessels.flexible=true",
                     "--set",
                     "vessels.spacing=15 um",
                     "--set",
                     R"(zoom=[{"kind": "half_space", "point": ["0 um", "0 um", "0 um"],)"
                     R"( "normal": [0, 1, 0]}])"};
    const auto with = [&more](Words first) {
      first.insert(first.end(), more.begin(), more.end());
      return first;
    };
    const Json end = finish(model + "_whole", model, with({}));
    EXPECT_GE(end["cells"]["divisions"], 3);
    EXPECT_GT(end["measures"]["largest_vessel_displacement_um"], 0.01);
    finish(model + "_parts", model, with({"--until", "140 min"}));
    finish(model + "_parts", model, with({"--resume", "--until", "260 min"}));
    finish(model + "_parts", model, with({"--resume"}));
    expect_same(model + "_whole", model + "_parts");
  }
}

TEST_F(LifeResume, IsBitForBitWithSleepersRulesAndDeath) {
  write("spheroid.json", kSpheroid);
  const Words more{"--set",
                   "life.sleep=true",
                   "--set",
                   R"(life.rules=[{"do": "rest", "share": 0.5, "from": "190 min"},)"
                   R"({"do": "die", "share": 0.4, "from": "260 min"}])",
                   "--set",
                   "motility.random=false",
                   "--set",
                   R"(cell_types.tumour.death={"mode": "lysis", "duration": "30 min"})"};
  for (const std::string model : {"dcm", "cbm"}) {
    const std::string whole = model + "_whole", parts = model + "_parts";
    const Json end = finish(whole, model, more);
    std::printf("%s: %s\n", model.c_str(), end["cells"].dump().c_str());
    double asleep = 0;
    const auto series = reader(whole).series();
    for (const double n : series.at("asleep")) asleep = std::max(asleep, n);
    EXPECT_GT(asleep, 0) << "the scene keeps everybody awake";
    Words first = more, next = more, last = more;
    first.insert(first.end(), {"--until", "200 min"});
    next.insert(next.end(), {"--resume", "--until", "280 min"});
    last.emplace_back("--resume");
    finish(parts, model, first);
    finish(parts, model, next);
    finish(parts, model, last);
    expect_same(whole, parts);
  }
}

}  // namespace
}  // namespace acinus::runs
