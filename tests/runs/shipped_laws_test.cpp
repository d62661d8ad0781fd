/// Stiffness laws that come with the program.

#include "runs/assemble/shipped_laws.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "calibration/law_file.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/calibrate/compression_scene.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

/// Scene of spheres with the law "auto".
Scene scene_with(const std::string& keys) {
  return parse_scene(
      R"({ "experiment": "free", "model": "cbm", "time": { "end": "1 h" },
           "cells": { "source": "list", "list": [ { "position": ["0 um", "0 um", "0 um"] } ] }, )" +
          keys + "}",
      "shipped_laws_test.json", scene_folder());
}

std::string name_of_law(Scene scene) {
  use_shipped_laws(scene);
  const std::string& law = scene.cell_types.begin()->second.cbm.stiffness_correction;
  return law == "auto" ? law : std::filesystem::path(law).stem().string();
}

std::string types(const std::string& values) {
  return R"("cell_types": { "a": { "cbm": { "stiffness_correction": "auto" }, )" + values + "} }";
}

TEST(ShippedLaws, FitTheCellsOfTable1) {
  for (const char* w : {"5e-6", "1e-5", "5e-5"})
    EXPECT_EQ(name_of_law(scene_with(types(fmt::format(R"("adhesion": "{} J/m^2")", w)))),
              std::string("hepatocyte_") + w);
  EXPECT_EQ(name_of_law(scene_with(types(R"("adhesion": "1e-5 J/m^2", "radius": "12 um")") +
                                   R"(, "contact": { "quadrature": "nodes-and-edges" })")),
            "hepatocyte_1e-5");
  EXPECT_EQ(
      name_of_law(scene_with(types(R"("adhesion": "1e-5 J/m^2")") + R"(, "accuracy": "fast")")),
      "hepatocyte_1e-5");
}

TEST(ShippedLaws, DoNotFitOtherCellsOrAnotherLawOfContact) {
  for (const char* values :
       {R"("adhesion": "2e-5 J/m^2")", R"("adhesion": "1e-5 J/m^2", "radius": "11 um")",
        R"("adhesion": "1e-5 J/m^2", "dcm": { "bulk_modulus": "2400 Pa" })",
        R"("adhesion": "1e-5 J/m^2", "dcm": { "nodes": 642 })",
        R"("adhesion": "1e-5 J/m^2", "dcm": { "cortex_tension": "1e-4 N/m" })"})
    EXPECT_EQ(name_of_law(scene_with(types(values))), "auto") << values;
  EXPECT_EQ(name_of_law(scene_with(types(R"("adhesion": "1e-5 J/m^2")") +
                                   R"(, "contact": { "max_depth": "2 um" })")),
            "auto");
}

TEST(ShippedLaws, AreSoundAndOfDifferentCells) {
  const std::vector<std::string> laws = shipped_laws();
  ASSERT_GE(laws.size(), 3);
  for (const std::string& file : laws) {
    const calibration::Law law = calibration::read_law(file);
    EXPECT_GT(law.friction_share, 0.05) << file;
    EXPECT_LT(law.friction_share, 0.9) << file;
    EXPECT_TRUE(law.warnings.empty()) << file << ": " << law.warnings.front();
    for (const std::string& other : laws)
      if (other != file) {
        const calibration::Law o = calibration::read_law(other);
        EXPECT_FALSE(calibration::list_differences(law, o.dcm, o.cbm).empty()) << file << other;
      }
  }
}

TEST(ShippedLaws, AreFoundByNameAndAMissingOneNamesThem) {
  const auto named = [](const char* law) {
    return scene_with(fmt::format(
        R"("cell_types": {{ "a": {{ "cbm": {{ "stiffness_correction": "{}" }} }} }})", law));
  };
  EXPECT_EQ(named("hepatocyte_5e-5").cell_types.at("a").cbm.stiffness_correction,
            fs::path(scene_folder()).parent_path() / "laws" / "hepatocyte_5e-5.json");
  for (const char* wrong : {"hepatocyte_5", "../laws", "hepatocyte_5e-5.json"}) {
    try {
      EXPECT_EQ(named(wrong).cell_types.at("a").cbm.stiffness_correction, "");
      ADD_FAILURE() << wrong << " was accepted";
    } catch (const Error& error) {
      EXPECT_CONTAINS(std::string(error.what()), "no such file: ");
      EXPECT_CONTAINS(std::string(error.what()), "shipped laws: ");
    }
  }
}

TEST(ShippedLaws, MatterWhereThereMayBeSpheres) {
  const auto scene = [](const std::string& model, const std::string& set) {
    return may_have_spheres(parse_scene(
        R"({ "experiment": "free", "time": { "end": "1 h" }, "cell_types": { "a": {} }, "cells": { "source": "list", )" +
            model + R"("list": [ { "position": ["0 um", "0 um", "0 um"] )" + set + "} ] } }",
        "shipped_laws_test.json", scene_folder()));
  };
  EXPECT_TRUE(scene(R"("model": "cbm", )", ""));
  EXPECT_FALSE(scene(R"("model": "dcm", )", ""));
  EXPECT_TRUE(scene(R"("model": "dcm", )", R"(, "model": "cbm")"));
}

TEST(ShippedLaws, ACellsAgeIsNotThatOfTheClumpItIsCalibratedIn) {
  // A random age would be a random size, and the clump would start inside its capsule.
  const Scene scene = scene_with(
      types(R"("adhesion": "1e-5 J/m^2", "cycle": { "time": "24 h", "start": "random" })"));
  const CellType& type = compression_scene(scene, {}).cell_types.at("a");
  EXPECT_EQ(type.cycle.time, 0);
  EXPECT_FALSE(type.cycle.random_start);
}

}  // namespace
}  // namespace acinus::runs
