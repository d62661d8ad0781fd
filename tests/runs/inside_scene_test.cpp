/// Scenes of cells with something inside, or whose tension varies: what they refuse.

#include <gtest/gtest.h>

#include <string>

#include "runs/assemble/build_params.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {

using namespace scene_texts;

std::string with_dcm(const std::string& keys) {
  return minimal(R"("hepatocyte": {})", R"("hepatocyte": {"dcm": {)" + keys + "}}");
}
std::string nucleus(const std::string& keys) {
  return failure(with_dcm(R"("nucleus": {)" + keys + "}"));
}
std::string contraction(const std::string& keys) {
  return failure(with_dcm(R"("cortex_tension": "1e-4 N/m", "contraction": {)" + keys + "}"));
}

TEST(NucleusScene, SaysWhatIsWrong) {
  EXPECT_EQ(nucleus(""), "");
  EXPECT_CONTAINS(nucleus(R"("young": "-1 kPa")"), R"(nucleus/young = "-1 kPa": must be >= 0 kPa)");
  EXPECT_CONTAINS(nucleus(R"("bulk_modulus": "-1 Pa")"), "must be >= 0 Pa");
  EXPECT_CONTAINS(nucleus(R"("link_young": "-1 kPa")"), "must be >= 0 kPa");
  EXPECT_CONTAINS(nucleus(R"("friction": "0 N s/m^3")"), "must be > 0 N s/m^3");
  EXPECT_CONTAINS(nucleus(R"("size": 1.1)"), "nucleus/size = 1.1: must be from 0.1 to 0.9");
  EXPECT_CONTAINS(nucleus(R"("nodes": 642)"),
                  "nucleus/nodes = 642: must not exceed /cell_types/hepatocyte/dcm/nodes = 162");
}

TEST(NucleusScene, MustFitWithItsGap) {
  EXPECT_CONTAINS(
      nucleus(R"("size": 0.88, "gap": "0.5 um")"),
      R"(nucleus/size = 0.88: is too large: that share of /cell_types/hepatocyte/radius = "12 um" )"
      R"(and /cell_types/hepatocyte/dcm/nucleus/gap = "0.5 um" beside it must fit into 0.9 of that)");
  EXPECT_CONTAINS(
      failure(changed(with_dcm(R"("nucleus": {"size": 0.8})"), R"(["0 um", "0 um", "0 um"])",
                      R"(["0 um", "0 um", "0 um"], "radius": "2 um")")),
      R"(that share of /cells/list/0/radius = "2 um")");
  EXPECT_CONTAINS(failure(changed(with_dcm(R"("nucleus": {"size": 0.85})"), "{\n  \"time\"",
                                  "{\"start_up\": {\"enabled\": true},\n  \"time\"")),
                  R"(that share of /start_up/initial_radius = "3 um")");
}

TEST(NucleusScene, WithoutAnyStiffnessIsLeftOut) {
  const Scene limp = parse_scene(
      with_dcm(R"("nucleus": {"young": "0 kPa", "bulk_modulus": "0 Pa"})"), "scene.json");
  EXPECT_FALSE(make_dcm_params(limp, limp.cell_types.at("hepatocyte")).nucleus);
  const Scene stiff = parse_scene(with_dcm(R"("nucleus": {})"), "scene.json");
  EXPECT_TRUE(make_dcm_params(stiff, stiff.cell_types.at("hepatocyte")).nucleus);
}

TEST(ContractionScene, SaysWhatIsWrong) {
  EXPECT_EQ(contraction(R"("ring": 2)"), "");
  EXPECT_CONTAINS(failure(with_dcm(R"("contraction": {"ring": 2})")),
                  R"(dcm/cortex_tension = "0 N/m": leaves /cell_types/hepatocyte/dcm/contraction )"
                  "nothing to vary");
  EXPECT_CONTAINS(contraction(R"("ring": -1)"), "ring = -1: must be >= 0");
  EXPECT_CONTAINS(contraction(R"("width": 0)"), "width = 0: must be > 0");
  EXPECT_CONTAINS(contraction(R"("axis": [0, 0, 0])"), "axis = [0, 0, 0]: has no direction");
  EXPECT_CONTAINS(contraction(R"("course": [{"time": "0 s", "factor": -1}])"),
                  "factor = -1: must be >= 0");
  EXPECT_CONTAINS(contraction(R"("course": [{"time": "2 s", "factor": 1}, {"factor": 1}])"),
                  R"(course/1/time = "0 s": must not be before)");
}

TEST(ContractionScene, WithACourseIsNotForSleepers) {
  const std::string text = changed(
      with_dcm(R"("cortex_tension": "1e-4 N/m", "contraction": {"course": [{"factor": 1}]})"),
      "{\n  \"time\"", "{\"life\": {\"sleep\": true},\n  \"time\"");
  EXPECT_CONTAINS(failure(text), "a tension that changes would not wake them");
}

}  // namespace
}  // namespace acinus::runs
