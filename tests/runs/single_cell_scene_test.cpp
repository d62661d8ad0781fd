/// Scenes of single-cell experiments: what they refuse.

#include <gtest/gtest.h>

#include <string>

#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {

using namespace scene_texts;

std::string stretcher(const std::string& keys) {
  return failure(with_block(R"("stretcher": {)" + keys + "}"));
}

constexpr const char* kPulse = R"(, "pulses": [{"from": "0 s", "to": "2 s"}])";

TEST(StretcherScene, SaysWhatIsWrong) {
  EXPECT_EQ(stretcher(std::string(R"("power": "1.1 W")") + kPulse), "");
  EXPECT_CONTAINS(stretcher(std::string(R"("power": "0 mW")") + kPulse),
                  R"(/stretcher/power = "0 mW": must be > 0 W)");
  EXPECT_CONTAINS(stretcher(R"("power": "1.1 W")"), "/stretcher/pulses: needs a pulse");
  EXPECT_CONTAINS(stretcher(R"("power": "1.1 W", "pulses": [{"from": "3 s", "to": "2 s"}])"),
                  R"(pulses/0/to = "2 s": must be after /stretcher/pulses/0/from = "3 s")");
  EXPECT_CONTAINS(stretcher(std::string(R"("power": "1.1 W", "cell_index": 1.3)") + kPulse),
                  "must be above /stretcher/medium_index = 1.33");
  EXPECT_CONTAINS(stretcher(std::string(R"("power": "1.1 W", "axis": [0, 0, 0])") + kPulse),
                  "/stretcher/axis = [0, 0, 0]: has no direction");
  EXPECT_CONTAINS(failure(with_block(R"("experiment": "optical_stretcher")")),
                  "needs a stretcher block");
}

TEST(StretcherScene, IsForDeformableCells) {
  const std::string text =
      changed(with_block(std::string(R"("stretcher": {"power": "1.1 W")") + kPulse + "}"),
              "\"dcm\"", "\"cbm\"");
  EXPECT_CONTAINS(failure(text), "is for deformable cells");
}

TEST(TemperatureScene, SaysWhatIsWrong) {
  const auto course = [](const std::string& entries) {
    return failure(with_block(R"("temperature": {"course": [)" + entries + "]}"));
  };
  EXPECT_EQ(course(R"({"value": "310 K"})"), "");
  EXPECT_CONTAINS(course(R"({"value": "-3 K"})"), R"(value = "-3 K": must be > 0 K)");
  EXPECT_CONTAINS(course(R"({"value": "310"})"), "has no unit; needed a temperature");
  EXPECT_CONTAINS(course(""), "/temperature/course = []: needs an entry");
  EXPECT_CONTAINS(course(R"({"time": "3 s", "value": "310 K"}, {"time": "2 s", "value": "310 K"})"),
                  R"(course/1/time = "2 s": must not be before /temperature/course/0/time)");
}

constexpr const char* kSuction = R"(, "suction": [{"time": "9 s", "pressure": "40 Pa"}])";

std::string pipette(const std::string& keys, const std::string& experiment = "aspiration") {
  return failure(with_block(R"("experiment": ")" + experiment + R"(", "pipette": {)" + keys + "}"));
}

TEST(PipetteScene, SaysWhatIsWrong) {
  const std::string sucks = std::string(R"("radius": "5 um")") + kSuction;
  EXPECT_EQ(pipette(sucks), "");
  EXPECT_EQ(pipette(sucks, "free"), "");
  EXPECT_CONTAINS(pipette(std::string(R"("radius": "12 um")") + kSuction),
                  R"(/pipette/radius = "12 um": must be below /cell_types/hepatocyte/radius = )"
                  R"("12 um": the cell would slip through)");
  EXPECT_EQ(pipette(std::string(R"("radius": "12 um")") + kSuction, "free"), "");
  EXPECT_CONTAINS(
      pipette(sucks + R"(, "thickness": "1.5 um")"),
      R"(/pipette/lip = "1 um": must be at most half of /pipette/thickness = "1.5 um")");
  EXPECT_CONTAINS(pipette(sucks + R"(, "length": "1 um")"),
                  R"(/pipette/lip = "1 um": must be at most half of /pipette/length = "1 um")");
  EXPECT_CONTAINS(pipette(R"("radius": "5 um")"), "/pipette/suction: needs a pressure above 0 Pa");
  EXPECT_CONTAINS(pipette(R"("radius": "5 um", "suction": [{"pressure": "0 Pa"}])"),
                  "needs a pressure above 0 Pa");
  EXPECT_CONTAINS(pipette(sucks + R"(, "axis": [0, 0, 0])"), "/pipette/axis = [0, 0, 0]: has no");
  EXPECT_CONTAINS(pipette(R"("radius": "5 um", "suction": [{"time": "9 s", "pressure": "1 Pa"},
                              {"time": "8 s", "pressure": "1 Pa"}])"),
                  R"(suction/1/time = "8 s": must not be before /pipette/suction/0/time = "9 s")");
  EXPECT_CONTAINS(failure(with_block(R"("experiment": "aspiration")")), "needs a pipette block");
}

TEST(PipetteScene, NarrowGapNeedsSomethingThatDrivesTheCell) {
  EXPECT_CONTAINS(pipette(R"("radius": "5 um")", "narrow_gap"),
                  R"(/experiment = "narrow_gap": needs something that drives the cell)");
  EXPECT_EQ(pipette(std::string(R"("radius": "5 um")") + kSuction, "narrow_gap"), "");
  EXPECT_CONTAINS(pipette(std::string(R"("radius": "13 um")") + kSuction, "narrow_gap"),
                  "must be below");
}

TEST(PipetteScene, SuctionIsForDeformableCells) {
  const std::string block =
      std::string(R"("experiment": "free", "pipette": {"radius": "5 um")") + kSuction + "}";
  EXPECT_CONTAINS(failure(changed(with_block(block), "\"dcm\"", "\"cbm\"")),
                  "/pipette/suction = [{...}]: is for deformable cells");
  EXPECT_CONTAINS(failure(with_block(block + R"(, "life": {"sleep": true})")),
                  "/pipette/suction = [{...}]: is not for cells that may sleep");
}

TEST(PlatesScene, NeedsTwoPlatesAndOneCell) {
  const auto plates = [](const std::string& second) {
    return with_block(
        R"("experiment": "plates", "walls": [{"normal": [0, 0, 2], "mirror": true}, {"mirror": true, "normal": )" +
        second + "}]");
  };
  EXPECT_EQ(failure(plates("[0, 0, -1]")), "");
  const std::string needs = R"(/experiment = "plates": needs two walls with opposite normals)";
  EXPECT_CONTAINS(failure(plates("[0, 1, -1]")), needs);
  EXPECT_CONTAINS(failure(with_block(R"("experiment": "plates")")), needs);
  EXPECT_CONTAINS(failure(changed(plates("[0, 0, -1]"), "\"dcm\"", "\"cbm\"")),
                  "is for deformable cells");
}

TEST(SeriesFriction, IsNotForEveryScene) {
  const auto with = [](const std::string& block) {
    return failure(changed(with_block(block), R"("hepatocyte": {})",
                           R"("hepatocyte": {"dcm": {"series_friction": "1e-3 N s/m"}})"));
  };
  EXPECT_EQ(with(R"("seed": 1)"), "");
  EXPECT_CONTAINS(with(R"("life": {"sleep": true})"), "is not for cells that may sleep");
}

std::string pulls(const std::string& entries, const std::string& experiment = "free") {
  return failure(
      with_block(R"("experiment": ")" + experiment + R"(", "pulls": [)" + entries + "]"));
}

TEST(PullScene, SaysWhatIsWrong) {
  constexpr const char* kForce = R"("force": [{"time": "9 s", "force": "1 nN"}])";
  constexpr const char* kSpring = R"("by": "spring", "stiffness": "1e-3 N/m")";
  EXPECT_EQ(pulls(std::string("{") + kForce + "}"), "");
  EXPECT_EQ(pulls(std::string("{") + kSpring + "}"), "");
  EXPECT_CONTAINS(pulls("{}"), "/pulls/0/force: needs an entry");
  EXPECT_CONTAINS(pulls(std::string(R"({"cell": 7, )") + kForce + "}"), "/pulls/0/cell = 7");
  EXPECT_CONTAINS(pulls(std::string(R"({"direction": [0, 0, 0], )") + kForce + "}"),
                  "has no direction");
  EXPECT_CONTAINS(pulls(R"({"by": "spring", "stiffness": "0 N/m"})"), "must be > 0 N/m");
  EXPECT_CONTAINS(pulls(R"({"by": "spring"})"), "stiffness");
  EXPECT_CONTAINS(pulls(R"({"force": [{"time": "9 s", "force": "1 nN"},
                            {"time": "8 s", "force": "1 nN"}]})"),
                  "must not be before /pulls/0/force/0/time");
  EXPECT_CONTAINS(pulls(std::string("{") + kForce + "}", "pull_off"), "looks at two cells");
}

TEST(PullScene, TearingTakesPullsInBothDirections) {
  constexpr const char* kRight =
      R"({"direction": [1, 0, 0], "by": "spring", "stiffness": "1e-3 N/m"})";
  constexpr const char* kLeft =
      R"({"direction": [-2, 0, 0], "by": "spring", "stiffness": "1e-3 N/m"})";
  constexpr const char* kUp =
      R"({"direction": [0, 0, 1], "by": "spring", "stiffness": "1e-3 N/m"})";
  const std::string comma = ", ";
  EXPECT_EQ(pulls(kRight + comma + kLeft, "tear"), "");
  for (const std::string& wrong :
       {std::string(), std::string(kRight), kRight + comma + kUp + comma + kLeft})
    EXPECT_CONTAINS(pulls(wrong, "tear"), "needs pulls along one line") << wrong;
}

TEST(PullScene, SpringsAreForDeformableCells) {
  const std::string text = changed(
      with_block(R"("pulls": [{"by": "spring", "stiffness": "1e-3 N/m"}])"), "\"dcm\"", "\"cbm\"");
  EXPECT_CONTAINS(failure(text), "is for deformable cells");
}

}  // namespace
}  // namespace acinus::runs
