/// Rules between the law of contact and what else a scene has.

#include <gtest/gtest.h>

#include "dcm/contact/contact_params.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

TEST(SceneContactLaw, ItsKeysAreRead) {
  const Scene scene = parse_scene(
      with_block(R"("contact": {"law": "maugis-dugdale", "h0": "50 nm", "modulus": "30 kPa", )"
                 R"("max_radius": "200 um"})"),
      "scene.json");
  EXPECT_EQ(scene.contact.cohesive_range, 0.05);
  EXPECT_EQ(scene.contact.modulus, 30);
  EXPECT_EQ(scene.contact.max_radius, 200);
  EXPECT_EQ(parse_scene(kMinimal, "scene.json").contact.law, dcm::ContactLaw::kCohesive);
}

TEST(SceneContactErrors, MaugisDugdaleActsBetweenTriangles) {
  const auto law = [](const std::string& more) {
    return with_block(R"("contact": {"law": "maugis-dugdale"})" + more);
  };
  const std::string start = R"(scene.json:1:22 /contact/law = "maugis-dugdale": )";
  EXPECT_EQ(failure(law("")), "");
  EXPECT_EQ(failure(law(R"(, "walls": [{"mirror": true}])")), "");
  EXPECT_EQ(failure(law(""), {"model=cbm"}), "");
  EXPECT_EQ(failure(law(""), {"contact.quadrature=nodes"}),
            start + "acts between triangles. Set /contact/quadrature to \"3-point\"");
  EXPECT_EQ(failure(law(""), {"friction.form=nodes"}), "");
  EXPECT_EQ(failure(with_block(R"("contact": {"h0": "20 nm"})")),
            R"(scene.json:1:21 /contact/h0 = "20 nm": is used only with law = maugis-dugdale. )"
            "Remove it");
}

TEST(SceneContactErrors, AdhesionsOfPairsNameAnotherTypeOnce) {
  const auto types = [](const std::string& of_a, const std::string& of_b) {
    return R"({"time": {"end": "1 h"}, "cell_types": {"a": {"adhesion_with": [)" + of_a +
           R"(]}, "b": {"adhesion_with": [)" + of_b +
           R"(]}}, "cells": {"source": "list", "list": [)"
           R"({"position": ["0 um", "0 um", "0 um"], "type": "a"}]}})";
  };
  const std::string with_a = R"({"type": "a", "adhesion": "1e-6 J/m^2"})",
                    with_b = R"({"type": "b", "adhesion": "1e-6 J/m^2"})",
                    with_bb = R"({"type": "bb", "adhesion": "1e-6 J/m^2"})";
  EXPECT_EQ(failure(types(with_b, "")), "");
  EXPECT_CONTAINS(failure(types(with_a, "")),
                  "/cell_types/a/adhesion_with/0/type = \"a\": is this type itself. Set "
                  "/cell_types/a/adhesion");
  EXPECT_CONTAINS(failure(types(with_b, with_a)),
                  "/cell_types/b/adhesion_with/0/type = \"a\": the adhesion of these two types is "
                  "given twice. Give it at one of them");
  EXPECT_CONTAINS(failure(types(with_b + ", " + with_b, "")), "is given twice");
  EXPECT_CONTAINS(failure(types(with_bb, "")), "unknown cell type. Known: a, b");
  EXPECT_CONTAINS(failure(types(R"({"type": "b"})", "")), "adhesion");
}

TEST(SceneCapsuleErrors, CapsulesAreWiderThanTheirCells) {
  const auto capsule = [](const std::string& keys) {
    return with_block(R"("capsule": {)" + keys + "}");
  };
  EXPECT_CONTAINS(
      failure(capsule(R"("radius": "12 um")")),
      R"(/capsule/radius = "12 um": must exceed the radius of "hepatocyte" cells, "12)");
  EXPECT_CONTAINS(
      failure(capsule(R"("radius": "20 um", "speed": "1 um/h", "min_radius": "11 um")")),
      R"(/capsule/min_radius = "11 um": must exceed the radius of "hepatocyte" cells)");
  EXPECT_EQ(failure(capsule(R"("radius": "12.1 um")")), "");
}

TEST(SceneVesselErrors, FlexibleVesselsNeedWhatTheyGoWith) {
  const std::string lobule = R"("lobule": {}, "vessels": {"flexible": true})";
  const std::string start = "/vessels/flexible = true: ";
  EXPECT_CONTAINS(failure(with_block(R"("vessels": {"flexible": true})")),
                  start + "needs vessels: give /vessels/file or a lobule block");
  EXPECT_CONTAINS(failure(with_block(lobule), {"life.sleep=true"}),
                  start + "goes only where all cells are awake: set /life/sleep to false");
  EXPECT_CONTAINS(failure(with_block(lobule), {"vessels.contact=mesh"}),
                  start +
                      "goes with cones only, which follow the vessels: set "
                      "/vessels/contact to \"cones\"");
  EXPECT_CONTAINS(failure(with_block(R"("lobule": {}, "vessels": {"spacing": "5 um"})")),
                  "/vessels/spacing = \"5 um\": is used only with flexible = true");
}

}  // namespace
}  // namespace acinus::runs
