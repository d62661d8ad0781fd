/// Scenes of single-cell experiments: what they refuse.

#include <gtest/gtest.h>

#include <string>

#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {

using namespace scene_texts;

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string stretcher(const std::string& keys) {
  return failure(with_block(R"("stretcher": {)" + keys + "}"));
}

constexpr const char* kPulse = R"(, "pulses": [{"from": "0 s", "to": "2 s"}])";

TEST(StretcherScene, SaysWhatIsWrong) {
  EXPECT_EQ(stretcher(std::string(R"("power": "1.1 W")") + kPulse), "");
  EXPECT_TRUE(says(stretcher(std::string(R"("power": "0 mW")") + kPulse),
                   R"(/stretcher/power = "0 mW": must be > 0 W)"));
  EXPECT_TRUE(says(stretcher(R"("power": "1.1 W")"), "/stretcher/pulses: needs a pulse"));
  EXPECT_TRUE(says(stretcher(R"("power": "1.1 W", "pulses": [{"from": "3 s", "to": "2 s"}])"),
                   R"(pulses/0/to = "2 s": must be after /stretcher/pulses/0/from = "3 s")"));
  EXPECT_TRUE(says(stretcher(std::string(R"("power": "1.1 W", "cell_index": 1.3)") + kPulse),
                   "must be above /stretcher/medium_index = 1.33"));
  EXPECT_TRUE(says(stretcher(std::string(R"("power": "1.1 W", "axis": [0, 0, 0])") + kPulse),
                   "/stretcher/axis = [0, 0, 0]: has no direction"));
  EXPECT_TRUE(
      says(failure(with_block(R"("experiment": "optical_stretcher")")), "needs a stretcher block"));
}

TEST(StretcherScene, IsForDeformableCells) {
  const std::string text =
      changed(with_block(std::string(R"("stretcher": {"power": "1.1 W")") + kPulse + "}"),
              "\"dcm\"", "\"cbm\"");
  EXPECT_TRUE(says(failure(text), "is for deformable cells")) << failure(text);
}

TEST(TemperatureScene, SaysWhatIsWrong) {
  const auto course = [](const std::string& entries) {
    return failure(with_block(R"("temperature": {"course": [)" + entries + "]}"));
  };
  EXPECT_EQ(course(R"({"value": "310 K"})"), "");
  EXPECT_TRUE(says(course(R"({"value": "-3 K"})"), R"(value = "-3 K": must be > 0 K)"));
  EXPECT_TRUE(says(course(R"({"value": "310"})"), "has no unit; needed a temperature"));
  EXPECT_TRUE(says(course(""), "/temperature/course = []: needs an entry"));
  EXPECT_TRUE(
      says(course(R"({"time": "3 s", "value": "310 K"}, {"time": "2 s", "value": "310 K"})"),
           R"(course/1/time = "2 s": must not be before /temperature/course/0/time)"));
}

TEST(SeriesFriction, IsNotForEveryScene) {
  const auto with = [](const std::string& block) {
    return failure(changed(with_block(block), R"("hepatocyte": {})",
                           R"("hepatocyte": {"dcm": {"series_friction": "1e-3 N s/m"}})"));
  };
  EXPECT_EQ(with(R"("seed": 1)"), "");
  EXPECT_TRUE(says(with(R"("life": {"sleep": true})"), "is not for cells that may sleep"));
}

}  // namespace
}  // namespace acinus::runs
