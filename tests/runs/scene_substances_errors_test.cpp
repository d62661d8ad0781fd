/// Rules of substances, exchange and responses: messages of what cannot be.

#include <gtest/gtest.h>

#include "runs/assemble/build_rules.hpp"
#include "runs/scene/writer.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

constexpr const char* kOxygen = R"("substances": [{"name": "oxygen", "diffusion": "2000 um^2/s"}])";

/// One cell with these blocks.
std::string scene_with_substances(const std::string& blocks, const std::string& type = "") {
  return R"({"time": {"end": "1 h"}, "cell_types": {"a": {"radius": "12 um")" +
         (type.empty() ? type : ", " + type) +
         R"(}}, "cells": {"model": "cbm", "list": [{"position": ["0 um", "0 um", "0 um"]}]}, )" +
         blocks + "}";
}

/// Complaint about a scene, without the place.
std::string substance_complaint(const std::string& text) {
  const std::string all = failure(text);
  const std::size_t at = all.find(" /");
  return at == std::string::npos ? all : all.substr(at + 1);
}

TEST(SceneSubstances, KeysAreRead) {
  const Scene scene =
      parse_scene(scene_with_substances(
                      R"("substances": [{"name": "drug", "unit": "uM", "diffusion": "1e-10 m^2/s",
        "decay": "0.36 1/h", "initial": 2, "cells": "keep_out",
        "boundary": {"kind": "exchange", "value": 3, "coefficient": "2 um/s"},
        "faces": [{"side": "z_high", "kind": "no_flux"}]}],
        "substance_grid": {"spacing": "5 um", "step": "1 min"},
        "rules": [{"signal": "drug", "behaviour": "death", "half_max": 4, "rate": "3.6 1/h"}])",
                      R"("exchange": [{"substance": "drug", "uptake": "0.5 1/s"}])"),
                  "scene.json");
  const SubstanceBlock& drug = scene.substances.at(0);
  EXPECT_DOUBLE_EQ(drug.diffusion, 100);
  EXPECT_DOUBLE_EQ(drug.decay, 1e-4);
  EXPECT_EQ(drug.boundary.kind, substances::FaceKind::kExchange);
  EXPECT_EQ(drug.faces.at(0).side, BoxFace::kZHigh);
  EXPECT_TRUE(drug.outside_cells());
  EXPECT_FALSE(drug.outside_obstacles);
  EXPECT_EQ(scene.substance_grid.step, 60);
  EXPECT_DOUBLE_EQ(scene.rules.at(0).rate, 1e-3);
  EXPECT_EQ(scene.cell_types.at("a").exchange.at(0).uptake, 0.5);
}

TEST(SceneSubstancesErrors, NamesMustBeThoseOfSubstances) {
  const std::string rule =
      R"("rules": [{"signal": "oxigen", "behaviour": "growth", "half_max": 1}])";
  EXPECT_EQ(substance_complaint(scene_with_substances(kOxygen + (", " + rule))),
            "/rules/0/signal = \"oxigen\": is neither a substance of the scene nor a signal of the "
            "cell. Did you mean \"oxygen\"?");
  EXPECT_EQ(substance_complaint(scene_with_substances(rule)),
            "/rules/0/signal = \"oxigen\": is neither a substance of the scene nor a signal of the "
            "cell. Known: pressure, volume, contact_area, neighbours, layer, age");
  EXPECT_EQ(substance_complaint(
                scene_with_substances(kOxygen, R"("exchange": [{"substance": "glucose"}])")),
            "/cell_types/a/exchange/0/substance = \"glucose\": is no substance. Known: oxygen");
  EXPECT_EQ(substance_complaint(scene_with_substances(
                kOxygen + std::string(R"(, "motility": {"leader_signal": "x"})"))),
            "/motility/leader_signal = \"x\": is no substance. Known: oxygen");
  EXPECT_EQ(substance_complaint(scene_with_substances(
                kOxygen + std::string(R"(, "rules": [{"signal": "oxygen", "behaviour": "growth",
                  "half_max": 1, "cell_type": "b"}])"))),
            "/rules/0/cell_type = \"b\": unknown cell type. Known: a");
}

TEST(SceneSubstancesErrors, RulesOfExchangeNameWhatIsExchanged) {
  const auto rule = [](const std::string& behaviour, const std::string& of) {
    return kOxygen + (R"(, "rules": [{"signal": "oxygen", "behaviour": ")" + behaviour +
                      R"(", "half_max": 1)" + of + "}]");
  };
  const char* const secretes = R"("exchange": [{"substance": "oxygen", "secretion": "1 1/s"}])";
  EXPECT_NO_THROW(parse_scene(
      scene_with_substances(rule("secretion", R"(, "of": "oxygen")"), secretes), "scene.json"));
  EXPECT_EQ(
      substance_complaint(scene_with_substances(rule("uptake", R"(, "of": "oxygen")"), secretes)),
      "/rules/0/of = \"oxygen\": no cell type has uptake of it: the rule is a factor on that of "
      "cell_types.<name>.exchange");
  EXPECT_EQ(
      substance_complaint(scene_with_substances(rule("uptake", R"(, "of": "oxigen")"), secretes)),
      "/rules/0/of = \"oxigen\": is no substance. Did you mean \"oxygen\"?");
  EXPECT_EQ(substance_complaint(scene_with_substances(rule("uptake", ""), secretes)),
            "/rules/0/of = \"\": must name the substance that is secreted or taken up");
}

TEST(SceneSubstances, RulesTakeSignalsOfCellsInTheirUnits) {
  const auto rules = [](const std::string& list) {
    return scene_with_substances(R"("rules": [)" + list + "]");
  };
  const Scene scene =
      parse_scene(rules(R"({"signal": "pressure", "behaviour": "growth", "half_max": "200 Pa"},
               {"signal": "volume", "behaviour": "death", "half_max": "9e-15 m^3", "rate": "1 1/h"},
               {"signal": "contact_area", "behaviour": "adhesion", "half_max": "600 um^2"},
               {"signal": "neighbours", "behaviour": "growth", "half_max": 6, "neighbour_type": "a"},
               {"signal": "layer", "behaviour": "growth", "half_max": 2},
               {"signal": "age", "behaviour": "motility", "half_max": "5 h"})"),
                  "scene.json");
  const double half[] = {0.2, 9000, 600, 6, 2, 18000};
  for (std::size_t k = 0; k < std::size(half); ++k) {
    EXPECT_NEAR(scene.rules[k].half_max, half[k], 1e-9 * half[k]) << k;
    EXPECT_NE(scene.rules[k].signal, coupling::Signal::kConcentration) << k;
  }
  EXPECT_EQ(describe_rule(scene, scene.rules[0]),
            "growth of all cells rises with pressure: half at 200 Pa, power 4");
  EXPECT_EQ(describe_rule(scene, scene.rules[3]),
            "growth of all cells rises with the number of a neighbours: half at 6, power 4");
  const Scene again = parse_scene(write_resolved(scene), "scene.json");
  EXPECT_EQ(again.rules[5].half_max, 18000);
}

TEST(SceneSubstancesErrors, SignalsOfCellsHaveTheirUnits) {
  const auto complaint = [](const std::string& rule, const std::string& more = "") {
    return substance_complaint(scene_with_substances(more + R"("rules": [{)" + rule + "}]"));
  };
  EXPECT_CONTAINS(complaint(R"("signal": "pressure", "behaviour": "growth", "half_max": 200)"),
                  "/rules/0/half_max = 200: ");
  EXPECT_CONTAINS(complaint(R"("signal": "age", "behaviour": "growth", "half_max": "3 um")"),
                  "/rules/0/half_max = \"3 um\": ");
  EXPECT_CONTAINS(complaint(R"("signal": "neighbours", "behaviour": "growth", "half_max": "3 h")"),
                  "/rules/0/half_max = \"3 h\": ");
  EXPECT_EQ(complaint(R"("signal": "neighbours", "behaviour": "growth", "half_max": 3,
                          "neighbour_type": "b")"),
            "/rules/0/neighbour_type = \"b\": unknown cell type. Known: a");
  EXPECT_EQ(complaint(R"("signal": "age", "behaviour": "chemotaxis", "half_max": "3 h",
                          "force": "1 nN")"),
            "/rules/0/of = \"\": must name the substance whose gradient cells follow: \"age\" has "
            "none");
  EXPECT_EQ(substance_complaint(scene_with_substances(
                R"("substances": [{"name": "age", "diffusion": "2 um^2/s"}])")),
            "/substances/0/name = \"age\": is a signal of cells in rules. Take another name");
}

TEST(SceneSubstancesErrors, NoConcentrationIsNegative) {
  EXPECT_EQ(substance_complaint(scene_with_substances(
                R"("substances": [{"name": "x", "diffusion": "1 um^2/s", "initial": -1}])")),
            "/substances/0/initial = -1: must be >= 0");
  EXPECT_EQ(substance_complaint(scene_with_substances(
                R"("substances": [{"name": "x", "diffusion": "-1 um^2/s"}])")),
            "/substances/0/diffusion = \"-1 um^2/s\": must be >= 0 um^2/s");
}

TEST(SceneSubstancesErrors, VoxelsAreNoLargerThanCells) {
  EXPECT_EQ(substance_complaint(scene_with_substances(
                kOxygen + std::string(R"(, "substance_grid": {"spacing": "30 um"})"))),
            "/substance_grid/spacing = \"30 um\": is larger than a cell of type a, \"24 um\" "
            "across: its surroundings would be those of its neighbours. Take at most that, better "
            "half of it");
  EXPECT_EQ(
      substance_complaint(scene_with_substances(kOxygen + std::string(R"(, "substance_grid": {"box":
                  [["0 um", "5 um", "0 um"], ["9 um", "5 um", "9 um"]]})"))),
      "/substance_grid/box/0/1 = \"5 um\": must be below /substance_grid/box/1/1 = \"5 um\"");
}

TEST(SceneSubstancesErrors, BoxThatGrowsNeedsAConcentrationOutside) {
  const auto with = [](const std::string& keys) {
    return scene_with_substances(R"("substances": [{"name": "x", "diffusion": "1 um^2/s")" + keys +
                                 R"(}], "substance_grid": {"grow": true})");
  };
  EXPECT_EQ(substance_complaint(with(R"(, "boundary": {"kind": "no_flux"})")),
            "/substance_grid/grow = true: no face of the box can grow: each has no_flux for a "
            "substance. Give boundary or faces of kind fixed or exchange, with the concentration "
            "outside");
  const std::string fixed = R"(, "boundary": {"kind": "fixed", "value": 1})";
  EXPECT_EQ(substance_complaint(with(fixed + R"(, "cells": "keep_out")")),
            "/substance_grid/grow = true: a box that grows holds cells and medium only: leave out "
            "/substances/0/cells, or give a /substance_grid/box that stays");
  EXPECT_NO_THROW(parse_scene(with(fixed), "scene.json"));
}

TEST(SceneSubstancesErrors, UnitIsNamed) {
  EXPECT_EQ(substance_complaint(scene_with_substances(
                R"("substances": [{"name": "x", "unit": "", "diffusion": "1 um^2/s"}])")),
            "/substances/0/unit = \"\": must not be empty: \"1\" for none");
}

TEST(SceneSubstancesErrors, NothingIsSaidTwice) {
  EXPECT_EQ(substance_complaint(
                scene_with_substances(R"("substances": [{"name": "x", "diffusion": "1 um^2/s"},
              {"name": "x", "diffusion": "2 um^2/s"}])")),
            "/substances/1/name = \"x\": another substance has this name");
  EXPECT_EQ(substance_complaint(
                scene_with_substances(R"("substances": [{"name": "x", "diffusion": "1 um^2/s",
              "faces": [{"side": "x_low"}, {"side": "x_low"}]}])")),
            "/substances/0/faces/1/side = \"x_low\": another entry has this face");
  EXPECT_EQ(substance_complaint(
                scene_with_substances(R"("substances": [{"name": "x", "diffusion": "1 um^2/s",
              "vessels": {"concentration": 1, "permeability": "1 um/s"}}])")),
            "/substances/0/vessels = {...}: needs vessels: give /vessels/file or a lobule block");
}

}  // namespace
}  // namespace acinus::runs
