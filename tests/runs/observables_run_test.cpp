/// /observables of whole runs: resumed bit for bit, the same for any number of threads.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "runs/experiments/observables.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

/// Small lobule of spheres that divide every two hours, with leaders.
constexpr const char* kLobule = R"({
  "seed": 4,
  "experiment": "lobule",
  "model": "cbm",
  "time": {"end": "3 h", "step": "60 s", "tolerance": "0.3 um"},
  "cell_types": {"hepatocyte": {"adhesion": "5e-5 J/m^2", "cycle": {"time": "2 h", "start": "random"}}},
  "start_up": {"enabled": true, "growth_time": "20 min", "max_duration": "1 h"},
  "cells": {"source": "lobule"},
  "lobule": {"radius": "130 um", "height": "30 um", "lesion_radius": "60 um", "cells": 10,
             "portal_vein_radius": "10 um", "vessel_fraction": 0.05},
  "motility": {"leader_force": "0.3 nN"},
  "output": {"every": "20 min"}
})";

class ObservablesRun : public ProgramTest {
 protected:
  void run(const std::string& out, const Words& more = {}) const {
    const Outcome outcome = call(run_words("lobule.json", out, more));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
  }
};

TEST_F(ObservablesRun, HaveAColumnForEachAndARowForEachFrame) {
  write("lobule.json", kLobule);
  run("a");
  const io::RunReader r = reader("a");
  const auto table = r.observables();
  std::set<std::string> expected{"time"};
  for (const Observable& o : known_observables(Experiment::kLobule)) expected.insert(o.name);
  for (const char* wall : {"outer", "radial_low", "radial_high", "bottom", "top"})
    for (const Observable& o : wall_observables(wall)) expected.insert(o.name);
  std::set<std::string> found;
  for (const auto& [name, values] : table) {
    found.insert(name);
    EXPECT_EQ(std::ssize(values), r.n_frame()) << name;
    for (const double v : values) EXPECT_TRUE(std::isfinite(v)) << name;
  }
  EXPECT_EQ(found, expected);
  for (int k = 0; k < r.n_frame(); ++k) EXPECT_EQ(table.at("time")[k], r.time_s(k));
  const Json s = summary("a"), m = s["measures"];
  EXPECT_EQ(m["lesion_area_open"].size(), table.at("time").size());
  EXPECT_GT(m["max_overlap_with_vessels_um"], 0) << "spheres do stand in vessels";
  EXPECT_TRUE(m.contains("closed_d"));
  EXPECT_EQ(table.at("births").back(), s["cells"]["divisions"]);
  EXPECT_GT(table.at("births").back(), 0);
}

TEST_F(ObservablesRun, OfAResumedRunAreThoseOfAWholeOne) {
  write("lobule.json", kLobule);
  run("whole");
  run("parts", {"--until", "70 min"});
  run("parts", {"--resume", "--until", "2 h"});
  run("parts", {"--resume"});
  // The last frame of a part may stand between those of the grid; births are what is counted.
  const auto whole = reader("whole").observables(), parts = reader("parts").observables();
  ASSERT_EQ(whole.at("time").back(), parts.at("time").back());
  for (const char* name :
       {"births", "births_layer_1", "births_layer_2", "cells", "lesion_area_open",
        "lesion_area_relative", "front_roughness_um", "wall_top_force_nN"})
    EXPECT_EQ(whole.at(name).back(), parts.at(name).back()) << name;
}

TEST_F(ObservablesRun, DoNotDependOnTheNumberOfThreads) {
  write("lobule.json", kLobule);
  const Words hybrid{
      "--set",
      "model=zoom",
      "--set",
      R"(zoom=[{"kind": "axis_distance", "min_distance": "0 um", "max_distance": "80 um"}])",
      "--set",
      "cell_types.hepatocyte.dcm.nodes=42",
      "--until",
      "20 min"};
  Words one = hybrid, two = hybrid;
  two.insert(two.end(), {"--threads", "2"});
  run("one", one);
  run("two", two);
  EXPECT_EQ(reader("one").observables(), reader("two").observables());
}

}  // namespace
}  // namespace acinus::runs
