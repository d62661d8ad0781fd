/// Pictures of a start, before any step.

#include "runs/session/start_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/sphere.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::runs {
namespace {

Scene scene_with(const std::string& start_up, const std::string& model) {
  return parse_scene(R"({"time": {"end": "1 h"}, "cell_types": {"a": {"dcm": {"nodes": 42}}},
      "cells": {"source": "clump", "count": 3, "spacing": 1.1, "model": ")" +
                         model + R"("}, "start_up": {"enabled": )" + start_up + "}}",
                     "scene");
}

const io::Column& column(const io::Frame& frame, const std::string& name) {
  return *std::ranges::find(frame.cells.columns, name, &io::Column::name);
}

class StartFrames : public testing::TestWithParam<const char*> {};

TEST_P(StartFrames, HaveCellsOfFullSizeWithAndWithoutStartUp) {
  const StartFrame grown = make_start_frame(scene_with("true", GetParam())),
                   placed = make_start_frame(scene_with("false", GetParam()));
  EXPECT_EQ(grown.deformable + grown.spheres, 3);
  EXPECT_EQ(grown.deformable, placed.deformable);
  EXPECT_EQ(grown.frame.time_s, 0);
  const auto &a = column(grown.frame, "volume").value, &b = column(placed.frame, "volume").value;
  ASSERT_EQ(a.size(), 3u);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a[k], b[k], 1e-6 * b[k]);
    EXPECT_NEAR(a[k], sphere_volume(12), 0.02 * sphere_volume(12));
  }
  ASSERT_EQ(grown.frame.point.size(), placed.frame.point.size());
  for (std::size_t k = 0; k < grown.frame.point.size(); ++k)
    EXPECT_NEAR(grown.frame.point[k], placed.frame.point[k], 1e-3);
}

TEST_P(StartFrames, SayNothingOfLoads) {
  const StartFrame start = make_start_frame(scene_with("true", GetParam()));
  for (const io::Column& c : start.frame.cells.columns)
    EXPECT_TRUE(c.name == "center" || c.name == "radius" || c.name == "volume") << c.name;
  EXPECT_TRUE(start.frame.interface.ids.empty());
}

INSTANTIATE_TEST_SUITE_P(Models, StartFrames, testing::Values("dcm", "cbm"));

TEST(StartFrame, NeedsNoCalibration) {
  Scene scene = scene_with("true", "cbm");
  scene.cell_types.begin()->second.cbm.stiffness_correction = "auto";
  EXPECT_EQ(make_start_frame(scene).spheres, 3);
}

}  // namespace
}  // namespace acinus::runs
