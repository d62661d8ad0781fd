#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/entries.hpp"
#include "runs/scene/explain.hpp"
#include "runs/scene/schema.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "tests/paths.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

TEST(Scene, MinimalSceneHasEveryDefault) {
  const Scene scene = parse_scene(kMinimal, "folder/my scene.json");
  const Scene defaults;
  EXPECT_EQ(scene.name, "my_scene");
  EXPECT_EQ(scene.time.end, 7200);
  EXPECT_EQ(scene.numerics.max_step, defaults.numerics.max_step);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").dcm.nodes, 162);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").cbm.young, 0) << "auto";
  EXPECT_FALSE(scene.lobule);
  EXPECT_FALSE(scene.capsule.enabled);
  ASSERT_EQ(scene.cells.list.size(), 1u);
  EXPECT_EQ(scene.cells.list[0].type, "hepatocyte");
}

TEST(Scene, EveryFieldIsRead) {
  const Scene scene = parse_scene(kFull, "full.json");
  EXPECT_EQ(scene.seed, 18446744073709551615ull);
  EXPECT_EQ(scene.experiment, Experiment::kLobule);
  EXPECT_EQ(scene.time.end, 172800);
  EXPECT_FALSE(scene.numerics.adaptive);
  EXPECT_EQ(scene.numerics.tolerance, 0.005);
  EXPECT_EQ(scene.numerics.cg.max_iterations, 500);
  EXPECT_EQ(scene.cell_types.at("old").dcm.nodes, 642);
  EXPECT_EQ(scene.cell_types.at("old").cbm.young, 0.45);
  EXPECT_EQ(scene.cell_types.at("old").adhesion, 0.025);
  EXPECT_EQ(scene.cell_types.at("young").diffusion, 3e-4);
  EXPECT_EQ(scene.cells.list[0].position, Vec3(1, 2.7, -3));
  EXPECT_EQ(scene.cells.list[0].radius, 9.0);
  EXPECT_EQ(scene.cells.list[1].model, CellModel::kCbm);
  EXPECT_EQ(scene.cells.list[1].pull, Vec3(0, 0, 0.1));
  EXPECT_EQ(scene.cells.grid, (std::array<int, 3>{2, 3, 4}));
  ASSERT_EQ(scene.zoom.size(), 9u);
  EXPECT_EQ(scene.zoom[0].radius, 30);
  EXPECT_EQ(scene.zoom[1].high, Vec3(1, 2, 3));
  EXPECT_EQ(scene.zoom[2].normal, Vec3(1, 0, 0.5));
  EXPECT_EQ(scene.zoom[3].max_distance, 60);
  EXPECT_EQ(scene.axis_point, Vec3(1, 0, 0));
  EXPECT_EQ(scene.contact.range_factor, 0.4);
  EXPECT_FALSE(scene.friction.dcm_cbm);
  EXPECT_EQ(scene.friction.dcm_vessel, 1.0);
  EXPECT_EQ(scene.lobule->height, 72);
  EXPECT_EQ(scene.vessels.unit, 1000);
  EXPECT_EQ((*scene.vessels.crop)[1], Vec3(1, 2, 3));
  EXPECT_EQ(scene.walls[0].name, "wall0");
  EXPECT_EQ(scene.walls[1].name, "top wall");
  EXPECT_EQ(scene.walls[1].speed, 7.0 / 3600);
  EXPECT_TRUE(scene.walls[1].mirror);
  EXPECT_FALSE(scene.walls[2].mirror);
  EXPECT_EQ(scene.walls[2].adhesion, 0.01);
  EXPECT_EQ(scene.walls[2].young, 0.6);
  EXPECT_EQ(scene.walls[2].poisson, 0.4);
  EXPECT_TRUE(scene.capsule.enabled);
  EXPECT_EQ(scene.capsule.min_radius, 60);
  EXPECT_FALSE(scene.output.compress);
}

TEST(Scene, LifeIsRead) {
  const Scene scene = parse_scene(kFull, "full.json");
  EXPECT_EQ(scene.time.until_cells, 300);
  const CellType &old = scene.cell_types.at("old"), &young = scene.cell_types.at("young");
  EXPECT_EQ(old.cycle.time, 23.7 * 3600);
  EXPECT_EQ(old.cycle.spread, 0.07);
  EXPECT_EQ(old.cycle.mitosis, 3000);
  EXPECT_EQ(old.cycle.force_ramp, 0.2);
  EXPECT_EQ(old.cycle.axis, coupling::DivisionAxis::kGiven);
  EXPECT_EQ(old.cycle.direction, Vec3(0, 1, 1));
  EXPECT_TRUE(old.cycle.random_start);
  EXPECT_EQ(old.cycle.inhibition.by, coupling::InhibitedBy::kPressure);
  EXPECT_EQ(old.cycle.inhibition.threshold, 0.21);
  EXPECT_EQ(old.cycle.inhibition.power, 3);
  EXPECT_TRUE(old.cycle.death.lysis);
  EXPECT_EQ(old.cycle.death.duration, 7 * 3600);
  EXPECT_EQ(old.cycle.death.final_volume, 0.3);
  EXPECT_EQ(old.softening, 0.5);
  EXPECT_EQ(young.cycle.time, 0);
  EXPECT_EQ(young.cycle.inhibition.by, coupling::InhibitedBy::kVolume);
  EXPECT_EQ(young.cycle.inhibition.threshold, 0.8);
  EXPECT_FALSE(young.cycle.death.lysis);
  EXPECT_EQ(scene.life.grid, 420);
  ASSERT_EQ(scene.life.rules.size(), 2u);
  const LifeRuleBlock &rest = scene.life.rules[0], &die = scene.life.rules[1];
  EXPECT_FALSE(rest.die);
  ASSERT_TRUE(rest.region);
  EXPECT_EQ(rest.region->radius, 50);
  EXPECT_TRUE(rest.cells.empty());
  EXPECT_TRUE(rest.descendants);
  EXPECT_EQ(rest.from, 0);
  EXPECT_EQ(rest.until, 1.7 * 86400);
  EXPECT_EQ(rest.share, 1);
  EXPECT_TRUE(die.die);
  EXPECT_FALSE(die.region);
  // 2^53 + 1 has no double: lineage numbers are not read through one.
  EXPECT_EQ(die.cells, (std::vector<std::int64_t>{0, 9007199254740993}));
  EXPECT_FALSE(die.descendants);
  EXPECT_EQ(die.from, 18000);
  EXPECT_TRUE(std::isinf(die.until));
  EXPECT_EQ(die.share, 0.25);
}

TEST(Scene, ProliferationIsRead) {
  const Scene scene = parse_scene(
      R"({"time": {"end": "1 h"}, "cell_types": {"a": {"cycle": {"time": "24 h"},
          "inhibition": {"by": "density", "density_threshold": "1e-4 1/um^3"}}},
          "cells": {"source": "clump", "model": "cbm"},
          "friction": {"medium_area": "whole"},
          "motility": {"leaders": "sector", "leader_count": 36, "leader_slice": "20 um"},
          "life": {"proliferation": {"cells": 138, "layer_thickness": "20 um", "rates": [
            {"rate": "0.03 1/h", "until": "2 days"},
            {"first_layer": 2, "last_layer": 5, "rate": "0.01 1/h", "from": "6 h"}]}}})",
      "p.json");
  EXPECT_EQ(scene.cell_types.at("a").cycle.inhibition.threshold, 1e-4);
  EXPECT_TRUE(scene.contact.whole_medium_area);
  EXPECT_EQ(scene.motility.leaders, coupling::Leaders::kSector);
  EXPECT_EQ(scene.motility.leader_count, 36);
  EXPECT_EQ(scene.motility.leader_slice, 20);
  ASSERT_TRUE(scene.life.proliferation);
  const ProliferationBlock& p = *scene.life.proliferation;
  EXPECT_EQ(p.cells, 138);
  EXPECT_FALSE(p.edge_at_start);
  EXPECT_EQ(p.thickness, 20);
  ASSERT_EQ(p.rate.size(), 2u);
  EXPECT_EQ(p.rate[0].first_layer, 1);
  EXPECT_EQ(p.rate[0].last_layer, 1);
  EXPECT_NEAR(p.rate[0].rate, 0.03 / 3600, 1e-18);
  EXPECT_EQ(p.rate[0].until, 2 * 86400);
  EXPECT_EQ(p.rate[1].last_layer, 5);
  EXPECT_EQ(p.rate[1].from, 6 * 3600);
  EXPECT_TRUE(std::isinf(p.rate[1].until));
}

TEST(Scene, WithoutACycleNothingGrows) {
  const Scene scene = parse_scene(kMinimal, "scene.json");
  const CellType& type = scene.cell_types.at("hepatocyte");
  EXPECT_EQ(type.cycle.time, 0);
  EXPECT_EQ(type.cycle.inhibition.by, coupling::InhibitedBy::kNothing);
  EXPECT_TRUE(scene.life.rules.empty());
  EXPECT_EQ(scene.time.until_cells, 0);
}

TEST(Scene, CellsAreDeformableWhereNothingSaysTheirModel) {
  const std::string bare = changed(kMinimal, R"("model": "dcm", )", "");
  const auto model = [&bare](const std::vector<std::string>& set) {
    return parse_scene(bare, "scene.json", ".", set).cells.model;
  };
  const std::string regions = R"(zoom=[{"kind": "all"}])";
  EXPECT_EQ(model({}), CellModel::kDcm);
  EXPECT_EQ(model({"zoom=[]"}), CellModel::kDcm);
  EXPECT_EQ(model({"cells.model=auto"}), CellModel::kDcm);
  EXPECT_EQ(model({regions}), CellModel::kZoom);
  EXPECT_EQ(model({regions, "cells.model=auto"}), CellModel::kZoom);
  EXPECT_EQ(model({"cells.model=cbm"}), CellModel::kCbm);
  EXPECT_EQ(model({regions, "model=cbm"}), CellModel::kCbm);
  // The same scene as one that says it.
  EXPECT_EQ(parse_scene(bare, "scene.json").hash, parse_scene(kMinimal, "scene.json").hash);
  EXPECT_CONTAINS(failure(bare, {"cells.model=zoom"}), "needs at least one region in /zoom");
}

TEST(Scene, ModelReplacesTheModelOfAnyScene) {
  const auto model = [](const char* text, const std::string& to) {
    return parse_scene(text, "scene.json", ".", {"model=" + to}).cells.model;
  };
  EXPECT_EQ(model(kMinimal, "cbm"), CellModel::kCbm);
  EXPECT_EQ(model(kMinimal, "auto"), CellModel::kDcm);
  // Zoom regions stay but do not count, and cells with a model of their own keep it.
  const Scene full = parse_scene(kFull, "scene.json", ".", {"model=dcm"});
  EXPECT_EQ(full.cells.model, CellModel::kDcm);
  EXPECT_EQ(full.cells.list[1].model, CellModel::kCbm);
  EXPECT_EQ(full.zoom.size(), 9u);
  EXPECT_EQ(parse_scene(full.resolved_json, "scene.json").hash, full.hash);
}

TEST(Scene, ResolvedSceneReadsBackToTheSameScene) {
  for (const char* text : {kMinimal, kFull}) {
    const Scene first = parse_scene(text, "scene.json");
    const Scene second = parse_scene(first.resolved_json, "elsewhere/provenance.json", "/");
    EXPECT_EQ(second.resolved_json, first.resolved_json);
    EXPECT_EQ(second.hash, first.hash);
    EXPECT_EQ(second.name, first.name);
    // Bits, not digits: 7 um/h and 0.01 um/min have no short binary form.
    EXPECT_EQ(second.start_up.speed_tolerance, first.start_up.speed_tolerance);
    EXPECT_EQ(second.start_up.pressure_tolerance, first.start_up.pressure_tolerance);
    EXPECT_EQ(second.numerics.tolerance, first.numerics.tolerance);
    for (const auto& [name, type] : first.cell_types) {
      EXPECT_EQ(second.cell_types.at(name).cycle.time, type.cycle.time);
    }
    ASSERT_EQ(second.life.rules.size(), first.life.rules.size());
    for (std::size_t i = 0; i < first.life.rules.size(); ++i) {
      EXPECT_EQ(second.life.rules[i].until, first.life.rules[i].until);
      EXPECT_EQ(second.life.rules[i].cells, first.life.rules[i].cells);
    }
    ASSERT_EQ(second.walls.size(), first.walls.size());
    for (std::size_t i = 0; i < first.walls.size(); ++i) {
      EXPECT_EQ(second.walls[i].speed, first.walls[i].speed);
    }
  }
}

TEST(Scene, ResolvedSceneNamesEveryUnconditionalKey) {
  const std::string json = parse_scene(kFull, "scene.json").resolved_json;
  for (const Entry& entry : all_entries()) {
    if (entry.path == "extends" || entry.path.starts_with("static_meshes.") ||
        entry.path.starts_with("pulls."))
      continue;
    // kFull has leaders and contacts of another kind, rigid vessels, no proliferation and cells
    // slowed by other things.
    if (entry.path.starts_with("life.proliferation.") ||
        entry.path.starts_with("motility.leader_c") ||
        entry.path.starts_with("motility.leader_s") || entry.path.ends_with("density_threshold") ||
        entry.condition.find("maugis") != std::string::npos ||
        entry.condition.find("flexible") != std::string::npos)
      continue;
    const std::string name = entry.path.substr(entry.path.rfind('.') + 1);
    EXPECT_CONTAINS(json, "\"" + name + "\": ") << entry.path;
  }
}

TEST(Scene, HashFollowsTheContentsOnly) {
  const std::string hash = parse_scene(kMinimal, "scene.json").hash;
  EXPECT_EQ(hash.size(), 16u);
  EXPECT_EQ(parse_scene(std::string("// note\n") + kMinimal, "scene.json").hash, hash);
  EXPECT_EQ(parse_scene(minimal("2 h", "120 min"), "scene.json").hash, hash);
  EXPECT_EQ(parse_scene(with_block(R"("seed": 1)"), "scene.json").hash, hash);
  EXPECT_NE(parse_scene(with_block(R"("seed": 2)"), "scene.json").hash, hash);
  // The folder of a file does not count, its name does.
  TemporaryFolder folder;
  for (const char* name : {"a/net.txt", "b/net.txt", "b/web.txt"}) folder.write(name, "x");
  const auto hash_with = [&](const std::string& name) {
    return parse_scene(with_block(R"("vessels": {"file": ")" + name + "\"}"), "scene.json",
                       folder.path().string())
        .hash;
  };
  EXPECT_EQ(hash_with("a/net.txt"), hash_with("b/net.txt"));
  EXPECT_NE(hash_with("b/net.txt"), hash_with("b/web.txt"));
}

TEST(SceneSet, ReplacesAnyValue) {
  const auto scene = [](std::vector<std::string> set) {
    return parse_scene(kMinimal, "scene.json", ".", set);
  };
  EXPECT_EQ(scene({"time.end=3 h"}).time.end, 10800);
  EXPECT_EQ(scene({"/time/end=\"3 h\""}).time.end, 10800);
  EXPECT_EQ(scene({"cells.list.0.position.1=5 um"}).cells.list[0].position.y(), 5);
  EXPECT_EQ(scene({"cell_types.hepatocyte.dcm.nodes=642"}).cell_types.at("hepatocyte").dcm.nodes,
            642);
  EXPECT_TRUE(scene({"capsule.radius=50 um"}).capsule.enabled);
  EXPECT_FALSE(scene({"capsule.radius=50 um", "capsule=null"}).capsule.enabled);
  EXPECT_EQ(scene({"capsule=null", "capsule.radius=50 um"}).capsule.radius, 50);
  EXPECT_EQ(scene({"walls=[{\"name\": \"w\", \"mirror\": true}]"}).walls[0].name, "w");
  EXPECT_EQ(scene({"description=a, b: c"}).description, "a, b: c");
  EXPECT_EQ(scene({"description="}).description, "");
  EXPECT_EQ(scene({"seed=1", "seed=2"}).seed, 2u);
  EXPECT_EQ(scene({"cells.model=zoom", "zoom=[{\"kind\": \"all\"}]"}).zoom.size(), 1u);
}

TEST(SceneSet, ErrorsNameTheFlag) {
  EXPECT_EQ(failure(kMinimal, {"time.end=2"}),
            "--set time.end=2: /time/end = 2: a bare number; needed a time as a text with its "
            "unit, e.g. \"24 h\"");
  EXPECT_EQ(failure(kMinimal, {"time.stp=1 s"}),
            "--set time.stp=1 s: /time/stp: unknown key. Did you mean \"step\"? "
            "(acinus explain time.step)");
  EXPECT_EQ(failure(kMinimal, {"cells.list.7.radius=1 um"}),
            "--set cells.list.7.radius=1 um: /cells/list has 1 elements, so \"7\" must be a number "
            "from 0 to 0");
  EXPECT_EQ(failure(kMinimal, {"time.end.x=1"}),
            "--set time.end.x=1: /time/end = \"2 h\" has no parts");
  EXPECT_EQ(failure(kMinimal, {"time.end"}),
            "--set time.end: must be PATH=VALUE, e.g. --set time.end=\"2 h\"");
  EXPECT_EQ(failure(kMinimal, {"time..end=1"}), "--set time..end=1: the path has an empty name");
  EXPECT_EQ(failure(kMinimal, {"walls=[{]"}).substr(0, 36), "--set walls=[{]: /0: not valid JSON:");
  EXPECT_CONTAINS(failure(kMinimal, {"extends=a.json"}), "cannot be changed");
  EXPECT_CONTAINS(failure(kMinimal, {"name=\xFF"}), "UTF-8");
  // Mistakes of the file come first, then those of the flags.
  const std::string both = failure(minimal("\"2 h\"", "\"2 h\", \"stp\": 1"), {"seed=-1"});
  EXPECT_LT(both.find("scene.json:2:26 /time/stp"), both.find("--set seed=-1: /seed = -1"));
}

TEST(SceneFiles, PathsStartInTheFolderOfTheirSource) {
  TemporaryFolder folder;
  const std::string net = folder.write("data/net.txt", "x");
  folder.write("sub/base.json", with_block(R"("vessels": {"file": "../data/net.txt"})"));
  const std::string top = folder.write("top.json", R"({"extends": "sub/base.json"})");
  EXPECT_EQ(read_scene(top).vessels.file, net);
  const std::string wrong =
      folder.write("wrong.json", with_block(R"("vessels": {"file": "net.txt"})"));
  EXPECT_EQ(file_failure(wrong), wrong + ":1:23 /vessels/file = \"net.txt\": no such file: " +
                                     (folder.path() / "net.txt").string());
  // A path on the command line starts in the current folder.
  const fs::path before = fs::current_path();
  fs::current_path(folder.path() / "data");
  const Scene scene = read_scene(wrong, {"vessels.file=net.txt"});
  const std::string resolved = fs::canonical(scene.vessels.file).string();
  fs::current_path(before);
  EXPECT_EQ(resolved, fs::canonical(net).string());
  // Static meshes follow the same rule, and a resolved scene can be read from anywhere.
  const std::string meshes = folder.write(
      "meshes.json", with_block(R"("static_meshes": [{"file": "data/net.txt", "unit": "1 mm"}])"));
  const Scene with_mesh = read_scene(meshes);
  EXPECT_EQ(with_mesh.static_meshes[0].file, net);
  EXPECT_EQ(with_mesh.static_meshes[0].name, "mesh0");
  const Scene again = parse_scene(with_mesh.resolved_json, "x.json", "/");
  EXPECT_EQ(again.resolved_json, with_mesh.resolved_json);
  EXPECT_EQ(again.hash, with_mesh.hash);
}

TEST(SceneFiles, UnreadableFilesAreFileErrors) {
  for (const std::string path : {"/no/such/file.json", "/tmp", "/dev/null"})
    test::message_of([&] { read_scene(path); }, Exit::kFileError);
}

TEST(Registry, EntriesAreCompleteAndUnique) {
  std::vector<std::string> paths;
  for (const Entry& entry : all_entries()) {
    paths.push_back(entry.path);
    EXPECT_FALSE(entry.meaning.empty()) << entry.path;
    EXPECT_FALSE(entry.type.empty()) << entry.path;
    if (!entry.unit.empty()) {
      EXPECT_NO_THROW(format_quantity(1, entry.dimension, entry.unit)) << entry.path;
    }
    EXPECT_NO_THROW(explain_key(entry.path)) << entry.path;
    EXPECT_NO_THROW(explain_key(entry.short_path)) << entry.path;
  }
  std::sort(paths.begin(), paths.end());
  EXPECT_EQ(std::adjacent_find(paths.begin(), paths.end()), paths.end());
  std::printf("%zu keys in the registry\n", paths.size());
}

TEST(Explain, FindsKeysByPathShortPathAndName) {
  const std::string text = explain_key("cell.radius");
  EXPECT_EQ(text.find("cell_types.<name>.radius\n"), 0u);
  for (const char* part :
       {"a length", "unit     um", "default  \"12 um\"", "range    > 0 um", "paper    R_c"}) {
    EXPECT_CONTAINS(text, part);
  }
  EXPECT_EQ(explain_key("/cell_types/hepatocyte/radius"), text);
  EXPECT_EQ(explain_key("cell_types.<name>.radius"), text);
  EXPECT_CONTAINS(explain_key("viscosity"), "friction.viscosity");
  EXPECT_NE(explain_key("/cells/list/3/position").find("cells.list.<number>.position"), 0u - 1);
  EXPECT_EQ(test::message_of([] { explain_key("cell.raduis"); }),
            "no scene key \"cell.raduis\". Did you mean \"cell.radius\"? `acinus explain` lists "
            "all");
  for (const char* query : {"", ".", "///", "<", "\x01"}) EXPECT_THROW(explain_key(query), Error);
}

TEST(Explain, MarkdownPageIsUpToDate) {
  EXPECT_EQ(io::read_text_file(test::source_path("docs/reference/scene_keys.md")),
            explain_markdown())
      << "docs/reference/scene_keys.md is stale: acinus explain --markdown > "
         "docs/reference/scene_keys.md";
}

TEST(Schema, KnowsEveryKey) {
  const std::string schema = scene_schema();
  EXPECT_CONTAINS(schema, "https://json-schema.org/draft/2020-12/schema");
  for (const Entry& entry : all_entries()) {
    const std::string name = entry.path.substr(entry.path.rfind('.') + 1);
    EXPECT_CONTAINS(schema, "\"" + name + "\": {") << entry.path;
  }
}

TEST(ShippedScenes, AreValidAndDescribed) {
  const std::vector<ShippedScene> scenes = shipped_scenes();
  EXPECT_FALSE(scenes.empty());
  for (const ShippedScene& scene : scenes) {
    EXPECT_FALSE(scene.description.empty()) << scene.file;
    EXPECT_NO_THROW(read_scene(scene.file)) << file_failure(scene.file);
  }
}

TEST(ShippedScenes, TwoCellsTouch) {
  const Scene scene = read_scene(scene_folder() + "/two_cells.json");
  ASSERT_EQ(scene.cells.list.size(), 2u);
  // The surfaces of two meshes of 162 nodes stand out 0.14 um beyond the radius each.
  const double distance = (scene.cells.list[1].position - scene.cells.list[0].position).norm();
  EXPECT_GT(distance, 23);
  EXPECT_LT(distance, 24.5);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").adhesion, 0.01);
  EXPECT_EQ(scene.time.end, 7200);
  EXPECT_FALSE(scene.start_up.enabled);
  EXPECT_FALSE(scene.motility.random);
}

TEST(ShippedScenes, GrowingOnesDifferAsInThePaper) {
  const auto type_of = [](const std::string& name) {
    return read_scene(scene_folder() + "/" + name + ".json").cell_types.at("tumour");
  };
  // [VanLiedekerke2020, Fig. 7], in nN/um (1e-3 J/m^2) and um^2/s.
  const struct {
    const char* name;
    double adhesion, diffusion;
  } expected[] = {{"spheroid", 1e-2, 1e-4},
                  {"monolayer_type1", 1e-13, 1e-3},
                  {"monolayer_type2", 1e-2, 1e-4},
                  {"monolayer_type3", 5e-2, 1e-4}};
  for (const auto& e : expected) {
    const CellType type = type_of(e.name);
    EXPECT_EQ(type.adhesion, e.adhesion) << e.name;
    EXPECT_EQ(type.diffusion, e.diffusion) << e.name;
    EXPECT_EQ(type.cycle.time, 86400.0) << e.name;
    EXPECT_EQ(type.cycle.spread, 0.1) << e.name;
    const Scene scene = read_scene(scene_folder() + "/" + e.name + ".json");
    // Ten doublings make a thousand cells.
    EXPECT_GT(scene.time.end, 10 * 86400) << e.name;
    if (scene.experiment == Experiment::kSpheroid) continue;
    ASSERT_EQ(scene.walls.size(), 1u) << e.name;
    EXPECT_FALSE(scene.walls[0].mirror) << e.name;
    EXPECT_EQ(scene.walls[0].adhesion, 0.01) << e.name;
  }
}

TEST(ShippedScenes, EveryModelCanBeChosenFromOutside) {
  for (const ShippedScene& scene : shipped_scenes()) {
    for (const char* model : {"dcm", "cbm"}) {
      const std::vector<std::string> set{std::string("model=") + model};
      const Scene read = read_scene(scene.file);
      const bool deforms =
          read.stretcher || read.pipette || read.experiment == Experiment::kPlates ||
          read.experiment == Experiment::kPullOff || read.experiment == Experiment::kTear;
      if (std::string(model) == "cbm" && deforms) {
        EXPECT_CONTAINS(file_failure(scene.file, set), "is for deformable cells");
        continue;
      }
      EXPECT_NO_THROW(EXPECT_EQ(name_of_choice(model_of(read_scene(scene.file, set))), model))
          << file_failure(scene.file, set);
    }
  }
}

TEST(ShippedScenes, CopiesStandAlone) {
  TemporaryFolder folder;
  const std::string target = (folder.path() / "mine").string();
  const std::vector<std::string> written = copy_scene("two_cells", target);
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(read_scene(written[0]).hash, read_scene(scene_folder() + "/two_cells.json").hash);
  EXPECT_THROW(copy_scene("two_cells", target), Error);
  EXPECT_THROW(copy_scene("two_cell", target + "2"), Error);
}

}  // namespace
}  // namespace acinus::runs
