/// `acinus infer` as a user calls it: on two compressed spheres that separate, killed and resumed.

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kFriction = R"({
  "scene": "two_cells",
  "set": { "cells.model": "cbm", "time.end": "10 min", "output.every": "5 min",
           "cell_types.hepatocyte.adhesion": "0 J/m^2",
           "cells.list": [ { "position": ["-6 um", "0 um", "0 um"] }, { "position": ["6 um", "0 um", "0 um"] } ] },
  "parameters": [ { "key": "cell_types.hepatocyte.cbm.ecm_friction", "prior": "log_uniform",
                    "low": "1e8 N s/m^3", "high": "3e9 N s/m^3" } ],
  "target": "overlap.csv",
  "particles": 8, "populations": 3
})";

class InferProgram : public ProgramTest {
 protected:
  InferProgram() {
    write("friction.json", kFriction);
    write("overlap.csv",
          "time_min,observable,value,sd\n5,overlap_cbm_cbm_um,8.53,0.3\n10,overlap_cbm_cbm_um,5.9,"
          "0.3\n");
  }
  Outcome infer(const std::string& out, const std::string& jobs = "1",
                const Words& more = {}) const {
    Words all{"infer", "friction.json", "--out", out, "--jobs", jobs};
    all.insert(all.end(), more.begin(), more.end());
    return call(all);
  }
};

TEST_F(InferProgram, WritesThePosteriorWithAnyNumberOfJobs) {
  const Outcome first = infer("one.infer");
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_CONTAINS(first.text, "| cell_types.hepatocyte.cbm.ecm_friction |");
  for (const char* file : {"posterior.csv", "populations.csv", "simulations.csv", "report.md",
                           "corner.svg", "prediction_overlap_cbm_cbm_um.svg"})
    EXPECT_FALSE(text("one.infer/" + std::string(file)).empty()) << file;
  ASSERT_EQ(infer("two.infer", "2").code, 0);
  for (const char* file : {"posterior.csv", "simulations.csv", "report.md"})
    EXPECT_EQ(text("one.infer/" + std::string(file)), text("two.infer/" + std::string(file)));
  const Outcome again = infer("one.infer");  // nothing is simulated twice
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(text("one.infer/posterior.csv"), text("two.infer/posterior.csv"));
}

TEST_F(InferProgram, GivesTheSameAfterKills) {
  ASSERT_EQ(infer("whole.infer", "1", {"--quiet"}).code, 0);
  std::mt19937 random(4);
  for (int k = 0; k < 3; ++k) {
    Process process(path("."), {"infer", "friction.json", "--out", "killed.infer", "--jobs", "1"});
    process.await(fmt::format("population {}:", k));
    usleep(std::uniform_int_distribution<useconds_t>(50000, 600000)(random));
    process.send(SIGKILL);
    process.wait();
  }
  ASSERT_EQ(infer("killed.infer").code, 0);
  for (const char* file : {"posterior.csv", "simulations.csv", "report.md"})
    EXPECT_EQ(text("whole.infer/" + std::string(file)), text("killed.infer/" + std::string(file)));
}

TEST_F(InferProgram, ScansAGrid) {
  std::string scan = kFriction;
  const std::string from = R"("particles": 8, "populations": 3)";
  scan.replace(scan.find(from), from.size(), R"("method": "scan", "steps": 5)");
  write("scan.json", scan);
  const Outcome outcome = call({"infer", "scan.json", "--out", "scan.infer"});
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const std::string table = text("scan.infer/posterior.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 6);
  EXPECT_CONTAINS(table, "index,weight,distance,cell_types.hepatocyte.cbm.ecm_friction (N s/m^3)");
}

TEST_F(InferProgram, SaysWhatIsWrong) {
  write("overlap.csv", "time_min,observable,value,sd\n20,overlap_cbm_cbm_um,8.53,0.3\n");
  EXPECT_CONTAINS(infer("bad.infer").text, "overlap.csv:2: the time 1200 s lies outside the run");
  EXPECT_EQ(infer("bad.infer").code, 2);
  fs::create_directories(path("other"));
  write("other/file", "x");
  write("overlap.csv", "observable,value,sd\noverlap_cbm_cbm_um,8.53,0.3\n");
  EXPECT_CONTAINS(infer("other").text, "holds something that is no study");
}

}  // namespace
}  // namespace acinus::runs
