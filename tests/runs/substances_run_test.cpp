/// Runs with substances: resumed, with more threads, with both models, and what they leave.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/field_file.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Five cells that divide, starve in the middle and follow a gradient, some of them deformable.
constexpr const char* kTissue = R"({
  "seed": 3,
  "time": {"end": "200 min", "step": "5 min", "tolerance": "0.1 um"},
  "solver": {"tolerance": 0.02},
  "cell_types": {"tumour": {"dcm": {"nodes": 42}, "adhesion": "1e-5 J/m^2",
    "cycle": {"time": "3 h", "spread": 0.1, "mitosis": "30 min", "start": "random"},
    "death": {"mode": "lysis", "duration": "40 min"},
    "exchange": [{"substance": "oxygen", "uptake_max": "2 1/s", "half_max": 1},
                 {"substance": "signal", "secretion": "1e-3 1/s", "saturation": 4, "uptake": "1e-4 1/s"}]}},
  "cells": {"source": "clump", "count": 5},
  "substances": [
    {"name": "oxygen", "unit": "mmHg", "diffusion": "2000 um^2/s", "initial": 38,
     "boundary": {"kind": "fixed", "value": 38}},
    {"name": "signal", "diffusion": "20 um^2/s", "decay": "1e-3 1/s",
     "faces": [{"side": "x_high", "kind": "exchange", "value": 2, "coefficient": "0.5 um/s"}],
     "sources": [{"region": {"kind": "sphere", "center": ["60 um", "0 um", "0 um"], "radius": "20 um"},
                  "secretion": "0.01 1/s"}]}],
  "substance_grid": {"margin": "60 um", "step": "100 s"},
  "rules": [
    {"signal": "oxygen", "behaviour": "growth", "half_max": 20},
    {"signal": "signal", "behaviour": "death", "half_max": 0.5, "rate": "0.05 1/h"},
    {"signal": "signal", "behaviour": "chemotaxis", "half_max": 0.1, "force": "0.5 nN"}],
  "contact": {"quadrature": "nodes"},
  "motility": {"random": true, "grid": "10 min"},
  "output": {"every": "40 min"}
})";

class SubstancesRun : public ProgramTest {
 protected:
  Json finish(const std::string& out, Words more) const {
    const Outcome outcome = call(run_words("tissue.json", out, more));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return summary(out);
  }
  static Words with(Words first, const Words& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
  }
  const Words zoom_{"--set",
                    "model=zoom",
                    "--set",
                    R"(zoom=[{"kind": "half_space", "point": ["0 um", "0 um", "0 um"],)"
                    R"( "normal": [1, 0, 0]}])",
                    "--set",
                    R"(moving_zoom={"every": "30 min", "stay": "30 min"})"};
};

/// Keys of oxygen and of the signal around cells, and through their membranes.
struct Passage {
  std::string oxygen, signal;
};
const Passage kPassages[] = {{R"("cells": "keep_out")", R"("cells": "keep_out")"},
                             {R"("cells": "membrane", "permeability": "20 um/s")",
                              R"("cells": "membrane", "permeability": "0.05 um/s")"}};

/// The same tissue; the signal is also kept out of obstacles.
std::string around_cells(const Passage& passage) {
  std::string text = kTissue;
  for (const auto& [name, keys] :
       {std::pair{R"("name": "oxygen",)", " " + passage.oxygen + ","},
        std::pair{R"("name": "signal",)", " " + passage.signal + R"(, "obstacles": "keep_out",)"}})
    text.insert(text.find(name) + std::string(name).size(), keys);
  return text;
}

TEST_F(SubstancesRun, AroundCellsResumedIsBitForBit) {
  for (const Passage& passage : kPassages) {
    write("tissue.json", around_cells(passage));
    const Json end = finish("whole", with({"--overwrite"}, zoom_));
    EXPECT_GE(end["cells"]["divisions"], 3);
    finish("parts", with({"--overwrite", "--until", "40 min"}, zoom_));
    finish("parts", with({"--resume"}, zoom_));
    expect_same("whole", "parts");
    EXPECT_TRUE(io::read_text_file(path("whole/fields/frame_000005.vtkhdf")) ==
                io::read_text_file(path("parts/fields/frame_000005.vtkhdf")));
  }
}

TEST_F(SubstancesRun, AroundCellsThreadsDoNotMatterAndAmountsBalance) {
  for (const Passage& passage : kPassages) {
    write("tissue.json", around_cells(passage));
    const Words fine = with({"--overwrite", "--set", "substance_grid.spacing=4 um"}, zoom_);
    const Json start = finish("start", with({"--until", "5 s"}, fine));
    const Json one = finish("one", with({"--threads", "1", "--until", "2 h"}, fine));
    const Json two = finish("two", with({"--threads", "2", "--until", "2 h"}, fine));
    EXPECT_EQ(one["state_hash"], two["state_hash"]);
    for (const auto& [name, now] : one["substances"].items()) {
      const Json& then = start["substances"][name];
      double sum = 0;
      for (const char* gain : {"secreted_um3", "through_faces_um3", "from_sources_um3"})
        sum += now[gain].get<double>() - then[gain].get<double>();
      sum -= now["decayed_um3"].get<double>() - then["decayed_um3"].get<double>();
      const double amount = now["amount_um3"];
      EXPECT_NEAR(amount - then["amount_um3"].get<double>(), sum,
                  1e-11 * (amount + std::abs(now["through_faces_um3"].get<double>())))
          << name;
      EXPECT_GE(now["lowest"], 0);
    }
  }
}

TEST_F(SubstancesRun, ResumedIsBitForBit) {
  write("tissue.json", kTissue);
  for (const auto& [name, more] : {std::pair<std::string, Words>{"cbm", {"--set", "model=cbm"}},
                                   {"zoom", zoom_},
                                   {"sleep", {"--set", "model=cbm", "--set", "life.sleep=true"}}}) {
    const Json end = finish(name + "_whole", more);
    std::printf("%s: %s\n", name.c_str(), end["cells"].dump().c_str());
    EXPECT_GE(end["cells"]["divisions"], 3);
    finish(name + "_parts", with({"--until", "40 min"}, more));
    finish(name + "_parts", with({"--resume", "--until", "2 h"}, more));
    finish(name + "_parts", with({"--resume"}, more));
    expect_same(name + "_whole", name + "_parts");
    for (const char* frame : {"frame_000001.vtkhdf", "frame_000005.vtkhdf"})
      EXPECT_TRUE(io::read_text_file(path(name + "_whole/fields/" + frame)) ==
                  io::read_text_file(path(name + "_parts/fields/" + frame)))
          << name << " " << frame;
  }
}

TEST_F(SubstancesRun, ThreadsDoNotMatter) {
  write("tissue.json", kTissue);
  // Voxels so small that fields are shared among threads.
  const Words fine = with({"--set", "substance_grid.spacing=4 um", "--until", "40 min"}, zoom_);
  const Json one = finish("one", with({"--threads", "1"}, fine));
  const Json two = finish("two", with({"--threads", "2"}, fine));
  EXPECT_EQ(one["state_hash"], two["state_hash"]);
}

/// Four cells without substances that divide, die, move and adhere by signals of their own.
constexpr const char* kCrowd = R"({
  "seed": 5,
  "time": {"end": "200 min", "step": "5 min", "tolerance": "0.1 um"},
  "solver": {"tolerance": 0.02},
  "cell_types": {"tumour": {"dcm": {"nodes": 42}, "adhesion": "1e-5 J/m^2",
    "cycle": {"time": "3 h", "spread": 0.1, "mitosis": "30 min", "start": "random"},
    "death": {"mode": "lysis", "duration": "40 min"}}},
  "cells": {"source": "clump", "count": 4},
  "rules": [
    {"signal": "pressure", "behaviour": "growth", "direction": "decreases", "half_max": "100 Pa", "power": 1},
    {"signal": "neighbours", "behaviour": "motility", "half_max": 3, "power": 2},
    {"signal": "contact_area", "behaviour": "adhesion", "half_max": "100 um^2", "power": 1},
    {"signal": "volume", "behaviour": "adhesion", "direction": "decreases", "half_max": "9000 um^3"},
    {"signal": "layer", "behaviour": "motility", "half_max": 1, "power": 1},
    {"signal": "age", "behaviour": "death", "half_max": "3 h", "rate": "0.1 1/h"}],
  "life": {"grid": "7 min"},
  "contact": {"quadrature": "nodes"},
  "motility": {"random": true, "grid": "10 min"},
  "output": {"every": "40 min"}
})";

TEST_F(SubstancesRun, SignalsOfCellsAreBitForBitResumedAndThreaded) {
  write("tissue.json", kCrowd);
  for (const auto& [name, more] : {std::pair<std::string, Words>{"cbm", {"--set", "model=cbm"}},
                                   {"zoom", zoom_},
                                   {"sleep", {"--set", "model=cbm", "--set", "life.sleep=true"}}}) {
    const Json end = finish(name + "_whole", with({"--threads", "1"}, more));
    std::printf("%s: %s\n", name.c_str(), end["cells"].dump().c_str());
    EXPECT_GE(end["cells"]["divisions"], 3);
    const double adheres = end["measures"]["rule_2_response"].back();
    EXPECT_GT(adheres, 0);
    EXPECT_LT(adheres, 1);
    finish(name + "_parts", with({"--threads", "2", "--until", "40 min"}, more));
    finish(name + "_parts", with({"--threads", "2", "--resume", "--until", "80 min"}, more));
    finish(name + "_parts", with({"--threads", "2", "--resume"}, more));
    expect_same(name + "_whole", name + "_parts");
    EXPECT_EQ(end["state_hash"], summary(name + "_parts")["state_hash"]);
  }
}

TEST_F(SubstancesRun, RulesAreReadAloudAndCounted) {
  write("tissue.json", kCrowd);
  const Outcome checked = call({"check", "tissue.json"});
  EXPECT_CONTAINS(checked.text,
                  "rules.0: growth of all cells falls with pressure: half at 100 Pa, power 1\n");
  EXPECT_CONTAINS(checked.text,
                  "rules.5: death at up to 0.1 1/h of all cells rises with age: half "
                  "at 3 h, power 4\n");
  const Json end = finish("run", {"--set", "model=cbm", "--until", "80 min", "--set",
                                  "rules.1.half_max=1e9", "--set", "rules.5.half_max=\"900 h\""});
  const std::string notes = end["notes"].dump();
  EXPECT_CONTAINS(notes, "rules.5 acted on no cell in any frame by half or more: death at up to");
  EXPECT_EQ(notes.find("rules.1 acted"), std::string::npos) << notes;
  EXPECT_TRUE(end["measures"].contains("rule_1_cells")) << end["measures"].dump();
}

TEST_F(SubstancesRun, GrowingBoxResumedIsBitForBit) {
  write("tissue.json", R"({
  "time": {"end": "3 h", "step": "300 s"},
  "cell_types": {"a": {"radius": "12 um", "dcm": {"nodes": 42},
    "cycle": {"time": "4 h", "spread": 0.1, "start": "random"},
    "exchange": [{"substance": "oxygen", "uptake_max": "2 1/s", "half_max": 1}]}},
  "cells": {"source": "clump", "count": 5},
  "substances": [{"name": "oxygen", "unit": "mmHg", "diffusion": "2000 um^2/s", "initial": 38,
                  "boundary": {"kind": "fixed", "value": 38}}],
  "substance_grid": {"margin": "40 um", "step": "100 s", "grow": true,
                     "box": [["-70 um", "-70 um", "-70 um"], ["70 um", "70 um", "70 um"]]},
  "contact": {"quadrature": "nodes"},
  "motility": {"random": true, "grid": "10 min"},
  "output": {"every": "1 h"}
})");
  const Json end = finish("whole", zoom_);
  EXPECT_GE(end["cells"]["divisions"], 3);
  finish("parts", with({"--until", "1 h"}, zoom_));
  finish("parts", with({"--resume", "--until", "2 h"}, zoom_));
  finish("parts", with({"--resume"}, zoom_));
  expect_same("whole", "parts");
  const auto first = io::read_fields(path("whole"), 0), last = io::read_fields(path("whole"), 3);
  ASSERT_TRUE(first && last);
  EXPECT_GT(last->n[0], first->n[0]);
  EXPECT_LT(last->origin.x(), first->origin.x());
}

TEST_F(SubstancesRun, LeaveFieldsAndConcentrations) {
  write("tissue.json", kTissue);
  finish("run", {"--set", "model=cbm", "--until", "80 min"});
  const Json series = Json::parse(io::read_text_file(path("run/fields.vtkhdf.series")));
  ASSERT_EQ(series["files"].size(), 3U);
  EXPECT_EQ(series["files"][1]["name"], "fields/frame_000001.vtkhdf");
  EXPECT_EQ(series["files"][1]["time"], 2400);
  EXPECT_FALSE(fs::exists(path("run/fields/frame_000003.vtkhdf")));
  finish("run", {"--set", "model=cbm", "--until", "40 min", "--overwrite"});
  EXPECT_FALSE(fs::exists(path("run/fields/frame_000002.vtkhdf")));
}

TEST_F(SubstancesRun, CheckTellsTheGrid) {
  write("tissue.json", kTissue);
  const Outcome checked = call({"check", "tissue.json"});
  EXPECT_EQ(checked.code, 0);
  EXPECT_NE(checked.text.find("substances (oxygen, signal): "), std::string::npos) << checked.text;
  const Outcome large = call({"check", "tissue.json", "--set", "substance_grid.spacing=0.01 um"});
  EXPECT_EQ(large.code, 2);
  EXPECT_NE(large.text.find("GB of memory, and this machine has"), std::string::npos) << large.text;
  const Outcome box = call({"check", "tissue.json", "--set",
                            R"(substance_grid.box=[["-1 m", "-1 m", "-1 m"],)"
                            R"( ["1 m", "1 m", "1 m"]])"});
  EXPECT_EQ(box.code, 2);
  EXPECT_NE(box.text.find("most of it for fields of substances. Take a larger"), std::string::npos)
      << box.text;
  const Outcome outside = call({"check", "tissue.json", "--set",
                                R"(substance_grid.box=[["0 um", "0 um", "0 um"],)"
                                R"( ["50 um", "50 um", "50 um"]])"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.text.find("cells start outside the box of the fields (number "),
            std::string::npos)
      << outside.text;
}

TEST_F(SubstancesRun, SourcesAndVesselsMustReachTheGrid) {
  const auto refusal = [&](const std::string& blocks) {
    write("source.json", R"({"time": {"end": "1 h"}, "cell_types": {"a": {"radius": "12 um"}},
      "cells": {"model": "cbm", "list": [{"position": ["0 um", "0 um", "0 um"]}]},
      "substance_grid": {"spacing": "10 um", "box": [["-50 um", "-50 um", "-50 um"],
                                                     ["50 um", "50 um", "50 um"]]}, )" +
                             blocks + "}");
    const Outcome checked = call({"check", "source.json"});
    EXPECT_EQ(checked.code, 2) << checked.text;
    return checked.text;
  };
  const auto sphere = [&](const std::string& x, const std::string& radius) {
    return refusal(R"("substances": [{"name": "a", "diffusion": "1 um^2/s", "sources": [
      {"region": {"kind": "all"}, "secretion": "1 1/s"},
      {"region": {"kind": "sphere", "center": [")" +
                   x + R"(", "0 um", "0 um"], "radius": ")" + radius +
                   R"("}, "secretion": "1 1/s"}]}])");
  };
  const std::string outside =
      "/substances/0/sources/1/region holds the centre of no voxel, so the source would release "
      "nothing. The fields reach from (-50, -50, -50) to (50, 50, 50) um, in voxels of 10 um.";
  EXPECT_NE(sphere("200 um", "20 um").find(outside), std::string::npos);
  EXPECT_NE(sphere("0 um", "1 um").find(outside), std::string::npos);  // between centres
  write("far.swc", "1 0 200 0 0 5 -1\n2 0 300 0 0 5 1\n");
  EXPECT_NE(refusal(R"("substances": [{"name": "a", "diffusion": "1 um^2/s",
      "vessels": {"concentration": 1, "permeability": "1 um/s"}}],
      "vessels": {"file": "far.swc"})")
                .find("/substances/0/vessels: no vessel is in the box of the fields"),
            std::string::npos);
}

}  // namespace
}  // namespace acinus::runs
