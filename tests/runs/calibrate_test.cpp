/// `acinus calibrate` and `acinus compare` as a user calls them, on a small coarse clump that is
/// compressed fast, and scenes that name what came out.

#include <numbers>

#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kClump = R"({
  "name": "clump", "experiment": "capsule", "model": "dcm",
  "time": { "end": "4.4 h", "step": "60 s", "tolerance": "0.1 um" },
  "cell_types": { "a": { "adhesion": "0 J/m^2", "dcm": { "nodes": 42, "local_area_modulus": "1e-4 N/m" },
                         "cbm": { "young_spread": 0 } } },
  "cells": { "source": "clump", "count": 15, "lattice": "bcc" },
  "capsule": { "radius": "40 um", "speed": "3 um/h", "min_radius": "26.8 um" },
  "motility": { "random": false },
  "output": { "every": "6 min" }
})";

class Calibrate : public ProgramTest {
 protected:
  Calibrate() { write("clump.json", kClump); }

  Outcome calibrate(const Words& more = {}) const {
    Words words{"calibrate", "clump.json", "--out", "law.json", "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }
  void replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::string all = text(name);
    const auto at = all.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(name, all.replace(at, from.size(), to));
  }
};

TEST_F(Calibrate, WritesALawThatScenesUseAndRunsThatCompare) {
  const Words one_term{"--good-enough", "1"};
  const Outcome first = calibrate(one_term);
  ASSERT_EQ(first.code, 0) << first.text;
  for (const char* part :
       {"a1", "95 % interval", "range of d", "at walls they leave out", "relaxation after release"})
    EXPECT_CONTAINS(first.text, part);
  const Json law = json("law.json");
  EXPECT_GT(law["a1_kPa"], 0);
  EXPECT_GE(law["wall_recess"], 0);
  EXPECT_NEAR(law["cbm"]["young_kPa"].get<double>(), 0.45, 1e-12);
  // One inner cell of 15: a warning on the terminal, in the report and in the law.
  for (const char* part : {"acinus: warning: law.json: cells that are not at the capsule: 1;",
                           "--cells 59", "fit for other scenes                         no"})
    EXPECT_CONTAINS(first.text, part);
  EXPECT_FALSE(law["warnings"].empty());
  EXPECT_EQ(json("law.calibration/curves.json")["warnings"], law["warnings"]);
  for (const char* file : {"curves.json", "force.svg", "relaxation.svg"})
    EXPECT_TRUE(fs::exists(path(std::string("law.calibration/") + file))) << file;

  // Everything is there: the second time compresses nothing.
  const Json before = json("law.calibration/compression_dcm/summary.json");
  ASSERT_EQ(calibrate(one_term).code, 0);
  EXPECT_EQ(json("law.calibration/compression_dcm/summary.json"), before);
  EXPECT_EQ(json("law.json")["a1_kPa"], law["a1_kPa"]);

  const Words spheres{"--set", "model=cbm", "--set",
                      "cell_types.a.cbm.stiffness_correction=law.json"};
  Words words = run_words("clump.json", "used", spheres);
  std::erase(words, std::string("--quiet"));
  const Outcome used = call(words);
  EXPECT_EQ(used.code, 0) << used.text;
  EXPECT_CONTAINS(used.text, "kPa d^4");
  EXPECT_CONTAINS(used.text, "law.json: cells that are not at the capsule: 1;");
  EXPECT_FALSE(test::contains(used.text, "the law holds for")) << used.text;
  EXPECT_EQ(summary("used")["state_hash"],
            summary("law.calibration/compression_corrected")["state_hash"]);

  // A law for other cells causes a warning.
  words = run_words("clump.json", "other", spheres);
  words.insert(words.end(), {"--set", "cell_types.a.dcm.bulk_modulus=5 kPa"});
  std::erase(words, std::string("--quiet"));
  const Outcome other = call(words);
  EXPECT_EQ(other.code, 0) << other.text;
  EXPECT_CONTAINS(other.text, "bulk_modulus_kPa: the law holds for 2.5, here it is 5");

  const std::string runs = "law.calibration/compression_";
  const Outcome same = call({"compare", runs + "dcm", runs + "dcm", "--tolerance", "pressure=0",
                             "--tolerance", "positions=0", "--out", "same.json"});
  EXPECT_EQ(same.code, 0) << same.text;
  const Json compared = json("same.json");
  EXPECT_TRUE(compared["passes"]);
  for (const Json& row : compared["differences"]) EXPECT_EQ(row["difference"], 0) << row;
  EXPECT_TRUE(fs::exists(path("same_pressure.svg")));
  const Outcome apart =
      call({"compare", runs + "dcm", runs + "cbm", "--tolerance", "normal_force=0.01"});
  EXPECT_EQ(apart.code, 5) << apart.text;
  EXPECT_CONTAINS(apart.text, "BEYOND (rms at most 1 %)");
  EXPECT_CONTAINS(apart.text, "drag in");
}

TEST_F(Calibrate, LetsTwoCellsComeToRestIfTheyAdhere) {
  ASSERT_EQ(calibrate({"--no-relaxation"}).code, 0);
  EXPECT_FALSE(fs::exists(path("law.calibration/pair_dcm"))) << "without adhesion";
  EXPECT_FALSE(json("law.json").contains("pull_off_ratio")) << "without adhesion";
  replace("clump.json", "0 J/m^2", "1e-5 J/m^2");
  const Outcome first = calibrate({"--no-relaxation", "--fresh"});
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_CONTAINS(first.text, "overlap of two cells by themselves");
  const Json pair = json("law.calibration/pair_dcm/summary.json");
  EXPECT_EQ(pair["cells"]["dcm"], 2);
  EXPECT_CONTAINS(first.text, "pull-off of two cells, out of sample");
  const double ratio = json("law.json")["pull_off_ratio"];
  const Json curves = json("law.calibration/curves.json");
  EXPECT_NEAR(curves["pull_off_cbm_nN"].get<double>(), 1.5 * std::numbers::pi * 0.01 * 6, 1e-9)
      << "JKR";
  double mean = 0;
  for (const Json& force : curves["pull_off_dcm_nN"]) mean += force.get<double>() / 3;
  EXPECT_NEAR(ratio, mean / curves["pull_off_cbm_nN"].get<double>(), 1e-9);
  EXPECT_GT(ratio, 1) << "surfaces that flatten hold more than spheres";
  EXPECT_LT(ratio, 4);
  const Json slid = json("law.calibration/sliding_dcm/summary.json");
  ASSERT_EQ(calibrate({"--no-relaxation"}).code, 0);
  EXPECT_EQ(json("law.calibration/pair_dcm/summary.json"), pair) << "nothing runs twice";
  EXPECT_EQ(json("law.calibration/sliding_dcm/summary.json"), slid) << "nothing runs twice";
}

TEST_F(Calibrate, SlidesLayersForTheFrictionOfSpheres) {
  ASSERT_EQ(calibrate({"--no-relaxation"}).code, 0);
  EXPECT_EQ(json("law.json")["friction_share"], 0) << "layers without adhesion come apart";
  EXPECT_FALSE(fs::exists(path("law.calibration/sliding_dcm")));
  replace("clump.json", "0 J/m^2", "1e-5 J/m^2");
  const Outcome first = calibrate({"--no-relaxation", "--fresh"});
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_CONTAINS(first.text, "friction per area between spheres");
  EXPECT_TRUE(fs::exists(path("law.calibration/sliding.svg")));
  const double share = json("law.json")["friction_share"];
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 0.9) << "spheres with the same friction slide slower";
  const Json curves = json("law.calibration/curves.json");
  const double cells = curves["slid_dcm"]["slid_um"].back(),
               spheres = curves["slid_cbm_corrected"]["slid_um"].back();
  EXPECT_GT(cells, spheres) << "they shear elastically first";
  EXPECT_GT(spheres, 1.5 * curves["slid_cbm_equal_friction"]["slid_um"].back().get<double>());

  const Words used{
      "run",   "clump.json",     "--set",     "model=cbm",
      "--set", "time.end=1 min", "--set",     "cell_types.a.cbm.stiffness_correction=law.json",
      "--out", "used",           "--threads", "1"};
  EXPECT_CONTAINS(call(used).text,
                  fmt::format("friction between spheres {:.3g} N s/m^3", 5e10 * share));
  Words own = used;
  own.insert(own.end(), {"--set", "friction.cbm_cbm=2e10 N s/m^3", "--overwrite"});
  const Outcome kept = call(own);
  EXPECT_EQ(kept.code, 0) << kept.text;
  EXPECT_FALSE(test::contains(kept.text, "friction between spheres")) << kept.text;
}

TEST_F(Calibrate, GoesOnWhereItWasStopped) {
  Process process(path(""), {"calibrate", "clump.json", "--out", "law.json", "--threads", "1",
                             "--fresh", "--no-relaxation", "--set", "capsule.speed=3 um/h"});
  ASSERT_TRUE(process.await("1 thread"));
  process.send(SIGTERM);
  const Outcome stopped = process.wait();
  EXPECT_EQ(stopped.code, 75) << stopped.text;
  EXPECT_FALSE(fs::exists(path("law.json")));
  EXPECT_CONTAINS(stopped.text,
                  "acinus calibrate clump.json --out law.json --threads 1 "
                  "--no-relaxation --set 'capsule.speed=3 um/h'");
  EXPECT_FALSE(test::contains(stopped.text, "--resume")) << stopped.text;
  const Outcome again = calibrate({"--no-relaxation"});
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_CONTAINS(again.text, "resumed at");
  EXPECT_TRUE(fs::exists(path("law.json")));
}

TEST_F(Calibrate, BadInputIsRefusedWithTheReason) {
  EXPECT_EQ(calibrate({"--type", "b"}).code, 2);
  EXPECT_EQ(call({"calibrate"}).code, 2);
  const Outcome weak =
      calibrate({"--set", "capsule.min_radius=39.9 um", "--set", "time.end=30 min"});
  EXPECT_EQ(weak.code, 3) << weak.text;
  EXPECT_CONTAINS(weak.text, "Compress further");
  EXPECT_EQ(call({"compare", "nowhere", "here"}).code, 4);
  const Outcome unknown = call({"compare", "a", "b", "--tolerance", "presure=1"});
  EXPECT_EQ(unknown.code, 2) << unknown.text;
  EXPECT_CONTAINS(unknown.text, "Did you mean \"pressure\"?");
  EXPECT_EQ(call({"compare", "a"}).code, 2);

  const Words spheres{"--set", "model=cbm", "--set",
                      "cell_types.a.cbm.stiffness_correction=law.json"};
  const auto refuse = [&](const char* part) {
    const Outcome outcome = call(run_words("clump.json", "refused", spheres));
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_CONTAINS(outcome.text, part);
    EXPECT_FALSE(fs::exists(path("refused")));
  };
  refuse("no such file");
  write("law.json", R"({"schema_version": 9})");
  refuse("that of another version");
  write("law.json", R"({"schema_version": 1, "a0_kPa": NaN})");
  refuse("not JSON");
}

}  // namespace
}  // namespace acinus::runs
