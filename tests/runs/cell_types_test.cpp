/// Generated cells of more than one type: shares, regions, available volume.

#include "runs/assemble/cell_types.hpp"

#include <gtest/gtest.h>

#include <map>

#include "runs/assemble/build_params.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/cell_constants.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/assemble/place_cells.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::runs {
namespace {

/// Cells 8 and 12 um wide from their middles, without start-up.
Scene make_scene(const std::string& cells, const std::string& more = "") {
  return parse_scene(R"({
  "time": {"end": "1 h"}, "seed": 7, "motility": {"random": false},
  "cell_types": {"large": {"radius": "12 um"}, "small": {"radius": "8 um"}},
  "cells": {"model": "cbm", )" +
                         cells + "}" + more + "}",
                     "scene.json");
}

std::map<std::string, int> count_types(const std::vector<PlacedCell>& cells) {
  std::map<std::string, int> n;
  for (const PlacedCell& c : cells) ++n[c.type];
  return n;
}

TEST(CellTypes, AreDrawnByTheirShares) {
  const std::string types = R"("types": [{"type": "large", "share": 3}, {"type": "small"}])";
  const Scene scene = make_scene(R"("source": "clump", "count": 2000, )" + types);
  const auto cells = place_cells(scene, nullptr, {}, {});
  auto n = count_types(cells);
  EXPECT_EQ(n["large"] + n["small"], 2000);
  // binomial: 1500 +- sqrt(2000 * 0.75 * 0.25) = 19
  EXPECT_NEAR(n["large"], 1500, 4 * 19);
  for (const PlacedCell& c : cells) EXPECT_EQ(c.radius, c.type == "large" ? 12 : 8);
  // A lattice has space for the largest type.
  EXPECT_NEAR((cells[1].center - cells[0].center).norm(), 24, 1e-12);
  // Another place or model does not change who is what.
  const auto box = place_cells(make_scene(R"("source": "box", "grid": [20, 10, 10], )" + types),
                               nullptr, {}, {});
  for (std::size_t k = 0; k < cells.size(); ++k) EXPECT_EQ(cells[k].type, box[k].type);
}

TEST(CellTypes, RegionsComeFirst) {
  const Scene scene = make_scene(
      R"("source": "box", "grid": [10, 10, 10], "types": [{"type": "large"},
         {"type": "small", "region": {"kind": "half_space", "point": ["0 um", "0 um", "0 um"],
                                      "normal": [1, 0, 0]}},
         {"type": "large", "share": 1,
          "region": {"kind": "half_space", "point": ["-48 um", "0 um", "0 um"],
                     "normal": [1, 0, 0]}}])");
  int mixed[2] = {};
  for (const PlacedCell& c : place_cells(scene, nullptr, {}, {})) {
    if (c.center.x() > 0) {
      EXPECT_EQ(c.type, "large");
    } else if (c.center.x() > -48) {
      EXPECT_EQ(c.type, "small");
    } else {
      ++mixed[c.type == "large" ? 0 : 1];
    }
  }
  // three layers of 100 in both regions: 150 +- sqrt(300 / 4) = 9
  EXPECT_EQ(mixed[0] + mixed[1], 300);
  EXPECT_NEAR(mixed[0], 150, 4 * 9);
}

TEST(CellTypes, FillKeepsEachClearOfWallsByItsOwnRadius) {
  const Scene scene = make_scene(
      R"("source": "fill", "count": 150, "low": ["-60 um", "-60 um", "0 um"],
         "high": ["60 um", "60 um", "80 um"], "min_distance": "14 um",
         "types": [{"type": "large", "share": 0.5}, {"type": "small", "share": 0.5}])",
      R"(, "walls": [{"point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 1], "mirror": true}])");
  const BuiltWorld built = build_world(scene, Ranks::serial());
  const auto cells = place_cells(scene, nullptr, {}, built.world.params.boundary);
  ASSERT_EQ(cells.size(), 150u);
  double lowest[2] = {1e9, 1e9};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double& low = lowest[cells[i].type == "large" ? 0 : 1];
    low = std::min(low, cells[i].center.z());
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((cells[i].center - cells[j].center).norm(), 14);
  }
  EXPECT_GE(lowest[0], 12);
  EXPECT_GE(lowest[1], 8);
  EXPECT_LT(lowest[1], 12);  // small ones use the available volume
  // binomial: 75 +- sqrt(150 / 4) = 6
  EXPECT_NEAR(count_types(cells)["large"], 75, 4 * 6);
}

TEST(CellTypes, LobulesHaveThemToo) {
  const Scene scene = make_scene(
      R"("source": "lobule", "types": [{"type": "small"}, {"type": "large",
         "region": {"kind": "axis_distance", "max_distance": "200 um"}}])",
      R"(, "lobule": {"height": "30 um", "cells": 30}, "start_up": {"enabled": true})");
  const BuiltWorld built = build_world(scene, Ranks::serial());
  const cbm::State& s = built.world.state.cbm;
  ASSERT_GT(s.n_cell(), 10u);
  const std::vector<double> radius = cbm::radii_at(s, 1e9);
  int n[2] = {};
  for (std::size_t c = 0; c < s.n_cell(); ++c) {
    const bool inside = (cbm::center_of(s, c) - scene.axis_point).head<2>().norm() <= 200;
    EXPECT_EQ(s.type[c], inside ? 0 : 1);
    EXPECT_NEAR(radius[c], inside ? 12 : 8, 1e-9);
    ++n[inside ? 0 : 1];
  }
  EXPECT_GT(n[0], 0);
  EXPECT_GT(n[1], 0);
}

TEST(CellTypes, SofterOnesDifferInWhatSoftensAndInNothingElse) {
  const Scene scene = make_scene(R"("source": "clump", "count": 2, "types": [{"type": "large"}])");
  CellType type = scene.cell_types.at("large");
  type.softening = 0.3;
  const CellType soft = softened(type);
  const dcm::Params before = make_dcm_params(scene, type), after = make_dcm_params(scene, soft);
  EXPECT_DOUBLE_EQ(after.spring_stiffness, 0.3 * before.spring_stiffness);
  EXPECT_DOUBLE_EQ(after.bending_stiffness, 0.3 * before.bending_stiffness);
  EXPECT_DOUBLE_EQ(after.bulk_modulus, 0.3 * before.bulk_modulus);
  EXPECT_DOUBLE_EQ(after.adhesion, 0.3 * before.adhesion);
  EXPECT_EQ(after.area_modulus, before.area_modulus);
  EXPECT_EQ(after.cortex_thickness, before.cortex_thickness);
  EXPECT_EQ(after.medium_friction, before.medium_friction);
}

TEST(CellTypes, HaveAdhesionsOfPairsOfTypes) {
  const Scene scene = parse_scene(R"({
  "time": {"end": "1 h"},
  "cell_types": {
    "a": {"adhesion": "4e-6 J/m^2", "adhesion_with": [{"type": "c", "adhesion": "1e-6 J/m^2"}],
          "death": {"mode": "lysis", "softening": 0.25}},
    "b": {"adhesion": "9e-6 J/m^2"},
    "c": {"adhesion": "1e-6 J/m^2"}},
  "cells": {"source": "clump", "count": 2, "types": [{"type": "a"}]}})",
                                  "scene.json");
  const coupling::Params p = build_world(scene, Ranks::serial()).world.params;
  ASSERT_EQ(p.dcm.size(), 4u);  // the last: "a" in lysis
  const double expected[4][4] = {{4, 6, 1, 2}, {6, 9, 3, 3}, {1, 3, 1, 0.5}, {2, 3, 0.5, 1}};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_NEAR(1e3 * p.dcm[a].adhesion_with.at(b), expected[a][b], 1e-12) << a << b;
      EXPECT_EQ(p.cbm[a].adhesion_with.at(b), p.dcm[a].adhesion_with[b]);
    }
  const Scene plain = make_scene(R"("source": "clump", "count": 2, "types": [{"type": "large"}])");
  EXPECT_TRUE(build_world(plain, Ranks::serial()).world.params.dcm[0].adhesion_with.empty());
}

TEST(CellTypes, LawsDependOnTheConstantsOfEveryTerm) {
  const Scene scene = make_scene(R"("source": "clump", "count": 2, "types": [{"type": "large"}])");
  const CellType& type = scene.cell_types.at("large");
  const LawParameters whole = law_parameters(scene, type);
  EXPECT_EQ(whole.dcm.size(), 11u);
  for (double DcmBlock::*value : {&DcmBlock::cortex_young, &DcmBlock::cortex_poisson,
                                  static_cast<double DcmBlock::*>(&DcmBlock::cortex_thickness),
                                  static_cast<double DcmBlock::*>(&DcmBlock::area_modulus),
                                  static_cast<double DcmBlock::*>(&DcmBlock::cortex_tension),
                                  static_cast<double DcmBlock::*>(&DcmBlock::local_area_modulus),
                                  static_cast<double DcmBlock::*>(&DcmBlock::bulk_modulus)}) {
    CellType other = type;
    other.dcm.*value += 0.01;
    EXPECT_NE(law_parameters(scene, other).dcm, whole.dcm);
  }
}

}  // namespace
}  // namespace acinus::runs
