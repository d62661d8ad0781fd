/// Rules of the zoom: what its regions and their motion need of a scene.

#include <gtest/gtest.h>

#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

/// Clump of four cells with these regions, and more blocks.
std::string zoomed(const std::string& regions, const std::string& more = R"("moving_zoom": {})") {
  return R"({"time": {"end": "1 h"}, "cell_types": {"a": {"radius": "12 um"}}, "cells": {"source": "clump", "count": 4, )"
         R"("model": "zoom"}, "zoom": [)" +
         regions + "], " + more + "}";
}

/// Error message without its place in the file.
std::string complaint(const std::string& text) {
  const std::string all = failure(text);
  const std::size_t at = all.find(" /");
  return at == std::string::npos ? all : all.substr(at + 1);
}

constexpr const char* kNear = R"({"kind": "cells", "cells": [0], "max_distance": "30 um"})";

TEST(SceneZoom, ItsKeysAreRead) {
  const Scene scene = parse_scene(
      zoomed(R"({"kind": "pressure", "above": "20 Pa", "below": "5 Pa"}, )" + std::string(kNear),
             R"("moving_zoom": {"every": "2 h", "margin": "30 um", "stay": "1 h", "fade": "20 min",
                "at_once": 3, "most_deformable": 2})"),
      "scene.json");
  ASSERT_TRUE(scene.moving_zoom.has_value());
  EXPECT_EQ(scene.moving_zoom->grid, 7200);
  EXPECT_EQ(scene.moving_zoom->margin, 30);
  EXPECT_EQ(scene.moving_zoom->most_deformable, 2);
  EXPECT_DOUBLE_EQ(scene.zoom[0].above, 0.02);
  EXPECT_EQ(scene.zoom[1].cells, (std::vector<std::int64_t>{0}));
  EXPECT_TRUE(scene.zoom[1].offspring);
}

TEST(SceneZoomErrors, WhatIsFollowedMustBeThere) {
  EXPECT_EQ(complaint(zoomed(kNear)), "");
  EXPECT_EQ(complaint(zoomed(R"({"kind": "cells", "cells": [7], "max_distance": "30 um"})")),
            "/zoom/0/cells/0 = 7: is no cell of the start: their numbers go from 0 to 3");
  EXPECT_EQ(complaint(zoomed(R"({"kind": "cells", "cells": [], "max_distance": "30 um"})")),
            "/zoom/0/cells = []: follows no cell: name at least one");
  EXPECT_EQ(complaint(zoomed(R"({"kind": "front", "max_distance": "30 um"})")),
            "/zoom/0/kind = \"front\": follows the edge of a lesion, and there is none without a "
            "lobule block");
  EXPECT_EQ(complaint(zoomed(R"({"kind": "vessel", "max_distance": "30 um"})")),
            "/zoom/0/kind = \"vessel\": needs vessels: give /vessels/file or a lobule block");
}

TEST(SceneZoomErrors, ThresholdsMustBeApart) {
  EXPECT_EQ(complaint(zoomed(R"({"kind": "pressure", "above": "5 Pa", "below": "20 Pa"})")),
            "/zoom/0/below = \"20 Pa\": must be less than /zoom/0/above = \"5 Pa\", or cells "
            "change to and fro");
  EXPECT_EQ(complaint(zoomed(kNear, R"("moving_zoom": {"margin": "10 um"})")),
            "/moving_zoom/margin = \"10 um\": must be at least a cell diameter, \"24 um\", or "
            "cells at the edge change to and fro");
}

TEST(SceneZoomErrors, MovingRegionsNeedAMovingZoom) {
  EXPECT_EQ(complaint(zoomed(kNear, R"("moving_zoom": null)")),
            "/zoom/0/kind = \"cells\": moves with the tissue: give a moving_zoom block that says "
            "how often cells are looked at (acinus explain moving_zoom)");
  EXPECT_EQ(complaint(zoomed(R"({"kind": "all"})",
                             R"("life": {"rules": [{"do": "rest", "region": {"kind": "cells",
                                "cells": [1], "max_distance": "30 um"}}]})")),
            "/life/rules/0/region/kind = \"cells\": moves with the tissue, which only regions of "
            "/zoom can do. Choose sphere, box, half_space, axis_distance or all");
  EXPECT_CONTAINS(complaint(zoomed("")), "/moving_zoom = {}: has no region to follow");
}

TEST(SceneZoomErrors, OtherIntegratorsDoNotFollow) {
  std::string text = zoomed(kNear);
  text.replace(text.find("1 h\""), 4, R"(1 h", "integrator": "newton")");
  EXPECT_EQ(complaint(text),
            "/time/integrator = \"newton\": cannot follow cells that change their model "
            "(/moving_zoom). Choose \"linearly-implicit\"");
}

TEST(SceneZoomErrors, CellsModelFromOutsideIsNotHiddenByModel) {
  EXPECT_EQ(failure(kMinimal, {"model=dcm", "cells.model=cbm"}),
            "--set cells.model=cbm: /cells/model = \"cbm\": has no effect, since /model = \"dcm\" "
            "stands in its place. Take --set model=cbm");
  EXPECT_EQ(failure(kMinimal, {"model=cbm", "cells.model=cbm"}), "");
}

}  // namespace
}  // namespace acinus::runs
