#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "core/error.hpp"
#include "runs/scene/document.hpp"
#include "runs/scene/explain.hpp"
#include "runs/scene/library.hpp"
#include "runs/scene/reader.hpp"
#include "runs/scene/registry.hpp"
#include "runs/scene/schema.hpp"
#include "runs/scene/writer.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;

constexpr const char* kMinimal = R"({
  "time": {"end": "2 h"},
  "cell_types": {"hepatocyte": {}},
  "cells": {"model": "dcm", "list": [{"position": ["0 um", "0 um", "0 um"]}]}
})";

/// Everything the reader can meet; every block present.
constexpr const char* kFull = R"({
  // a comment
  "name": "full", "description": "every block", "seed": 18446744073709551615,
  "experiment": "lobule",
  "time": {"end": "2 days", "step": "30 s", "min_step": "1 ms", "adaptive": false,
           "tolerance": "5 nm", "max_move": 0.25},
  "solver": {"tolerance": 1e-4, "max_iterations": 500},
  "start_up": {"enabled": true, "initial_radius": "3 um", "growth_time": "1 h"},
  "cell_types": {
    "old": {"radius": "11.3 um", "adhesion": "2.5e-5 J/m^2",
            "dcm": {"nodes": 642, "cortex_young": "0.9 kPa", "nodal_friction_kind": "axial"},
            "cbm": {"young": "450 Pa", "poisson": 0.47}},
    "young": {"diffusion": "3e-16 m^2/s"}},
  "cells": {"source": "list", "model": "zoom", "list": [
      {"position": ["1 um", "2.7 um", "-3 um"], "type": "old", "radius": "9 um"},
      {"position": ["40 um", "0 um", "0 um"], "type": "young", "model": "cbm",
       "pull": ["0 nN", "0 nN", "0.1 nN"]}], "grid": [2, 3, 4]},
  "zoom": [{"kind": "sphere", "center": ["0 um", "0 um", "0 um"], "radius": "30 um"},
           {"kind": "box", "low": ["0 um", "0 um", "0 um"], "high": ["1 um", "2 um", "3 um"]},
           {"kind": "half_space", "point": ["0 um", "0 um", "0 um"], "normal": [1, 0, 0.5]},
           {"kind": "axis_distance", "max_distance": "60 um"}, {"kind": "all"}],
  "axis_point": ["1 um", "0 um", "0 um"],
  "contact": {"quadrature": "nodes", "range": 0.4, "skin": "0.2 um"},
  "friction": {"dcm_cbm": "auto", "dcm_vessel": "1e9 N s/m^3", "medium": "liquid"},
  "motility": {"random": true, "leader_force": "0.3 nN"},
  "lobule": {"shape": "pie", "height": "72 um"},
  "vessels": {"unit": "1 mm", "scale": 2, "center": true,
              "crop": {"low": ["0 um", "0 um", "0 um"], "high": ["1 um", "2 um", "3 um"]}},
  "walls": [{"point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 1]},
            {"name": "top", "point": ["0 um", "0 um", "72 um"], "normal": [0, 0, -1],
             "speed": "7 um/h", "travel": "10 um"}],
  "capsule": {"radius": "100 um", "speed": "10 um/h", "min_radius": "60 um"},
  "output": {"every": "7 min", "compression": "none", "start_up": true}
  /* the end */
})";

std::string failure(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    parse_scene(text, "scene.json", ".", set);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

std::string minimal(const std::string& from, const std::string& to) {
  return changed(kMinimal, from, to);
}

std::string with_block(const std::string& block) {
  return minimal("{\n  \"time\"", "{ " + block + ",\n  \"time\"");
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "acinus_scene_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = path_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file.string();
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(Scene, MinimalSceneHasEveryDefault) {
  const Scene scene = parse_scene(kMinimal, "folder/my scene.json");
  const Scene defaults;
  EXPECT_EQ(scene.name, "my_scene");
  EXPECT_EQ(scene.time.end, 7200);
  EXPECT_EQ(scene.time.step, defaults.time.step);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").dcm.nodes, 162);
  EXPECT_FALSE(scene.cell_types.at("hepatocyte").cbm.young);
  EXPECT_FALSE(scene.lobule);
  EXPECT_FALSE(scene.capsule.enabled);
  ASSERT_EQ(scene.cells.list.size(), 1u);
  EXPECT_EQ(scene.cells.list[0].type, "hepatocyte");
}

TEST(Scene, EveryFieldIsRead) {
  const Scene scene = parse_scene(kFull, "full.json");
  EXPECT_EQ(scene.seed, 18446744073709551615ull);
  EXPECT_EQ(scene.experiment, "lobule");
  EXPECT_EQ(scene.time.end, 172800);
  EXPECT_FALSE(scene.time.adaptive);
  EXPECT_EQ(scene.time.tolerance, 0.005);
  EXPECT_EQ(scene.solver.max_iterations, 500);
  EXPECT_EQ(scene.cell_types.at("old").dcm.nodes, 642);
  EXPECT_EQ(scene.cell_types.at("old").cbm.young, 0.45);
  EXPECT_EQ(scene.cell_types.at("old").adhesion, 0.025);
  EXPECT_EQ(scene.cell_types.at("young").diffusion, 3e-4);
  EXPECT_EQ(scene.cells.list[0].position, Vec3(1, 2.7, -3));
  EXPECT_EQ(scene.cells.list[0].radius, 9.0);
  EXPECT_EQ(scene.cells.list[1].model, "cbm");
  EXPECT_EQ(scene.cells.list[1].pull, Vec3(0, 0, 0.1));
  EXPECT_EQ(scene.cells.grid, (std::array<int, 3>{2, 3, 4}));
  ASSERT_EQ(scene.zoom.size(), 5u);
  EXPECT_EQ(scene.zoom[0].radius, 30);
  EXPECT_EQ(scene.zoom[1].high, Vec3(1, 2, 3));
  EXPECT_EQ(scene.zoom[2].normal, Vec3(1, 0, 0.5));
  EXPECT_EQ(scene.zoom[3].max_distance, 60);
  EXPECT_EQ(scene.axis_point, Vec3(1, 0, 0));
  EXPECT_EQ(scene.contact.range, 0.4);
  EXPECT_FALSE(scene.friction.dcm_cbm);
  EXPECT_EQ(scene.friction.dcm_vessel, 1.0);
  EXPECT_EQ(scene.lobule->height, 72);
  EXPECT_EQ(scene.vessels.unit, 1000);
  EXPECT_EQ((*scene.vessels.crop)[1], Vec3(1, 2, 3));
  EXPECT_EQ(scene.walls[0].name, "wall0");
  EXPECT_EQ(scene.walls[1].speed, 7.0 / 3600);
  EXPECT_TRUE(scene.capsule.enabled);
  EXPECT_EQ(scene.capsule.min_radius, 60);
  EXPECT_EQ(scene.output.compression, "none");
}

TEST(Scene, ResolvedSceneReadsBackToTheSameScene) {
  for (const char* text : {kMinimal, kFull}) {
    const Scene first = parse_scene(text, "scene.json");
    const Scene second = parse_scene(first.resolved_json, "elsewhere/provenance.json", "/");
    EXPECT_EQ(second.resolved_json, first.resolved_json);
    EXPECT_EQ(second.sha, first.sha);
    EXPECT_EQ(second.name, first.name);
    // Bits, not digits: 7 um/h and 0.01 um/min have no short binary form.
    EXPECT_EQ(second.start_up.speed_tolerance, first.start_up.speed_tolerance);
    EXPECT_EQ(second.start_up.pressure_tolerance, first.start_up.pressure_tolerance);
    EXPECT_EQ(second.time.tolerance, first.time.tolerance);
    ASSERT_EQ(second.walls.size(), first.walls.size());
    for (std::size_t i = 0; i < first.walls.size(); ++i) {
      EXPECT_EQ(second.walls[i].speed, first.walls[i].speed);
    }
  }
}

TEST(Scene, ResolvedSceneNamesEveryUnconditionalKey) {
  const std::string json = parse_scene(kFull, "scene.json").resolved_json;
  for (const Entry& entry : all_entries()) {
    if (entry.path == "extends" || entry.path.starts_with("static_meshes.")) continue;
    const std::string name = entry.path.substr(entry.path.rfind('.') + 1);
    EXPECT_NE(json.find("\"" + name + "\": "), std::string::npos) << entry.path;
  }
}

TEST(Scene, HashFollowsTheContentsOnly) {
  const std::string sha = parse_scene(kMinimal, "scene.json").sha;
  EXPECT_EQ(sha.size(), 16u);
  EXPECT_EQ(parse_scene(std::string("// note\n") + kMinimal, "scene.json").sha, sha);
  EXPECT_EQ(parse_scene(minimal("2 h", "120 min"), "scene.json").sha, sha);
  EXPECT_EQ(parse_scene(with_block(R"("seed": 1)"), "scene.json").sha, sha);
  EXPECT_NE(parse_scene(with_block(R"("seed": 2)"), "scene.json").sha, sha);
  // The folder of a file does not count, its name does.
  TemporaryFolder folder;
  for (const char* name : {"a/net.txt", "b/net.txt", "b/web.txt"}) folder.write(name, "x");
  const auto hash = [&](const std::string& name) {
    return parse_scene(with_block(R"("vessels": {"file": ")" + name + "\"}"), "scene.json",
                       folder.path().string())
        .sha;
  };
  EXPECT_EQ(hash("a/net.txt"), hash("b/net.txt"));
  EXPECT_NE(hash("b/net.txt"), hash("b/web.txt"));
}

TEST(SceneErrors, UnknownKeyHasPlaceAndHint) {
  EXPECT_EQ(failure("{\n  \"time\": {\"end\": \"2 h\"},\n  \"cell_types\": {\"hepatocyte\": "
                    "{\n    \"raduis\": \"12 um\"}},\n  \"cells\": {\"model\": \"cbm\", \"list\": "
                    "[{\"position\": [\"0 um\", \"0 um\", \"0 um\"]}]}\n}"),
            "scene.json:4:5 /cell_types/hepatocyte/raduis: unknown key. Did you mean \"radius\"? "
            "(acinus explain cell.radius)");
  EXPECT_EQ(failure(minimal("\"time\"", "\"contakt\": {}, \"time\"")),
            "scene.json:2:3 /contakt: unknown key. Did you mean \"contact\"? "
            "(acinus explain contact)");
  EXPECT_EQ(failure(minimal("\"2 h\"", "\"2 h\", \"stp\": \"1 s\"")),
            "scene.json:2:26 /time/stp: unknown key. Did you mean \"step\"? "
            "(acinus explain time.step)");
  EXPECT_EQ(failure(minimal("\"2 h\"", "\"2 h\", \"quux\": 1")),
            "scene.json:2:26 /time/quux: unknown key. Known here: end, step, min_step, adaptive, "
            "tolerance, max_move");
}

TEST(SceneErrors, AllMistakesAreReportedAtOnceInOrder) {
  const std::string text = R"({
  "time": {"end": 7200, "step": "1 kPa", "min_step": "0 s"},
  "cell_types": {"hepatocyte": {"radius": "-1 um"}},
  "cells": {"model": "dmc", "list": [{"position": ["0 um", 5, "0 um"], "type": "hepatocite"}]},
  "seed": -1, "motility": {"random": "false"}
})";
  EXPECT_EQ(failure(text),
            "scene.json:2:19 /time/end = 7200: a bare number; needed a time as a text with its "
            "unit, e.g. \"24 h\"\n"
            "scene.json:2:33 /time/step = \"1 kPa\": has dimension force/length^2 (a stress), "
            "needed a time, e.g. \"24 h\"\n"
            "scene.json:2:54 /time/min_step = \"0 s\": must be > 0 s\n"
            "scene.json:3:43 /cell_types/hepatocyte/radius = \"-1 um\": must be > 0 um\n"
            "scene.json:4:22 /cells/model = \"dmc\": unknown choice. Did you mean \"dcm\"?\n"
            "scene.json:4:60 /cells/list/0/position/1 = 5: a bare number; needed a length as a "
            "text with its unit, e.g. \"12 um\"\n"
            "scene.json:4:80 /cells/list/0/type = \"hepatocite\": unknown cell type. Did you mean "
            "\"hepatocyte\"?\n"
            "scene.json:5:11 /seed = -1: must be a whole number from 0 to 2^64 - 1\n"
            "scene.json:5:38 /motility/random = \"false\": must be true or false, without quotes");
}

TEST(SceneErrors, MissingKeysAreNamed) {
  EXPECT_EQ(failure("{}"),
            "scene.json:1:1 /time/end: is missing: simulated time after t = 0, e.g. \"24 h\" "
            "(acinus explain time.end)\n"
            "scene.json:1:1 /cell_types: is missing: kinds of cells by name; at least one "
            "(acinus explain cell_types)\n"
            "scene.json:1:1 /cells/list: has no entry, but /cells/source = \"list\". Add cells, or "
            "take another source: clump, box, lobule\n"
            "scene.json:1:1 /cells/model = \"zoom\": needs at least one region in /zoom. Add one, "
            "or choose \"dcm\" or \"cbm\"");
  EXPECT_EQ(failure(minimal("\"position\": [\"0 um\", \"0 um\", \"0 um\"]", "")),
            "scene.json:4:38 /cells/list/0/position: is missing: centre of the cell, e.g. "
            "\"12 um\" (acinus explain cells.list.position)");
  EXPECT_EQ(failure(with_block(R"("capsule": {})")),
            "scene.json:1:14 /capsule/radius: is missing: inner radius at t = 0, e.g. \"12 um\" "
            "(acinus explain capsule.radius)");
}

TEST(SceneErrors, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(failure(minimal("{\"end\"", "/* \xC3\xA4\xE2\x82\xAC */ {\"raduis\": 1, \"end\""))
                .substr(0, 35),
            "scene.json:2:21 /time/raduis: unkno");
}

TEST(SceneErrors, DuplicateKeysAreRefused) {
  EXPECT_EQ(failure(minimal("\"2 h\"", "\"2 h\",\n    \"end\": \"3 h\"")),
            "scene.json:3:5 /time/end: given twice, first in line 2. Keep one of them");
}

TEST(SceneErrors, SyntaxErrorsHaveAPlace) {
  const auto starts = [](const std::string& text, const std::string& expected) {
    EXPECT_EQ(failure(text).substr(0, expected.size()), expected);
  };
  starts("", "scene.json:1:1 /: not valid JSON: unexpected end of input");
  starts("{\n  \"time\": {\"end\": \"2 h\",}\n}",
         "scene.json:2:25 /time: not valid JSON: unexpected '}'; expected string literal. Is there "
         "a comma too many?");
  starts("{\n  \"seed\": 01\n}", "scene.json:2:12 /: not valid JSON");
  starts("{\n  \"seed\": tru\n}", "scene.json:2:11 /: not valid JSON: invalid literal");
  starts("{\"seed\": 1} x", "scene.json:1:13 /: not valid JSON");
  starts("{\"seed\": 1e999}", "scene.json:1:10 /: not valid JSON: number overflow");
  starts("{\n\"name\": \"a\nb\"}", "scene.json:2:11 /: not valid JSON: invalid string: control");
  starts("{\n\"name\": \"abc", "scene.json:2:9 /: not valid JSON: invalid string: missing closing");
  starts("{\n\"na\xFFme\": 1}", "scene.json:2:4 /: the byte 0xff is not UTF-8 text");
  starts(std::string("{\0}", 3), "scene.json:1:2 /: a zero byte");
  starts("[1]", "scene.json:1:1 /: a scene is an object, { ... }, not [1]");
  starts("7", "scene.json:1:1 /: a scene is an object");
  starts("\xEF\xBB\xBF{\"seed\": 01}", "scene.json:1:11 /: not valid JSON");
}

TEST(SceneErrors, DepthAndSizeAreLimited) {
  EXPECT_EQ(failure(std::string(100000, '[')), "scene.json:1:65 /: nested deeper than 64 levels");
  std::string deep = "1";
  for (int i = 0; i < 100; ++i) deep = "{\"a\": " + deep + "}";
  EXPECT_NE(failure(deep).find("nested deeper than 64"), std::string::npos);
  std::string names = "{";
  for (int i = 0; i < 10001; ++i) names += "\"k" + std::to_string(i) + "\": 1, ";
  EXPECT_NE(failure(names).find("more than 10000 names"), std::string::npos);
  std::string values = "{\"walls\": [";
  for (std::size_t i = 0; i <= kMaxValues; ++i) values += "1,";
  EXPECT_NE(failure(values).find("values in one file"), std::string::npos);
  const std::string message = failure(minimal("\"2 h\"", "\"" + std::string(1 << 20, 'x') + "\""));
  EXPECT_LT(message.size(), 400u);
}

TEST(SceneErrors, LongListsOfMistakesAreCut) {
  std::string list;
  for (int i = 0; i < 500; ++i) list += "{\"position\": 1}, ";
  list += "{\"position\": 1}";
  const std::string message =
      failure(minimal("{\"position\": [\"0 um\", \"0 um\", \"0 um\"]}", list));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 200);
  EXPECT_NE(message.find("... and 301 more"), std::string::npos);
}

struct BrokenRule {
  const char* name;
  std::string text;
  const char* message;
};

TEST(SceneErrors, RulesBetweenKeys) {
  const std::string zoom_start = R"("zoom": [)";
  const auto zoomed = [&](const std::string& region) {
    return changed(with_block(zoom_start + region + "]"), "\"dcm\"", "\"zoom\"");
  };
  const auto wall = [](const std::string& body) { return with_block("\"walls\": [" + body + "]"); };
  const std::string at = "scene.json:";
  const BrokenRule rules[] = {
      {"step below min_step", minimal("\"2 h\"", R"("2 h", "step": "1 s", "min_step": "2 s")"),
       R"(scene.json:2:34 /time/step = "1 s": must not be below /time/min_step = "2 s". Raise step or lower min_step)"},
      {"default step below min_step", minimal("\"2 h\"", R"("2 h", "min_step": "70 s")"),
       R"(scene.json:2:38 /time/step = "60 s": must not be below /time/min_step = "70 s". Raise step or lower min_step)"},
      {"skin", with_block(R"("contact": {"skin": "0 um"})"),
       R"(scene.json:1:23 /contact/skin = "0 um": must be > 0 um)"},
      {"zoom without its model", with_block(R"("zoom": [{"kind": "all"}])"),
       R"(scene.json:1:11 /zoom = [{...}]: zoom regions need /cells/model = "zoom", not "dcm". Remove the regions (--set zoom=[]) or change the model)"},
      {"model zoom without regions", minimal("\"dcm\"", "\"zoom\""),
       R"(scene.json:4:22 /cells/model = "zoom": needs at least one region in /zoom. Add one, or choose "dcm" or "cbm")"},
      {"lobule cells without lobule", minimal("\"cells\": {", R"("cells": {"source": "lobule", )"),
       R"(scene.json:4:23 /cells/source = "lobule": needs a lobule block (acinus explain lobule))"},
      {"lobule experiment without lobule", with_block(R"("experiment": "lobule")"),
       R"(scene.json:1:17 /experiment = "lobule": needs a lobule block (acinus explain lobule))"},
      {"empty list", minimal("[{\"position\": [\"0 um\", \"0 um\", \"0 um\"]}]", "[]"),
       R"(scene.json:4:37 /cells/list = []: has no entry, but /cells/source = "list". Add cells, or take another source: clump, box, lobule)"},
      {"no cell type", minimal("{\"hepatocyte\": {}}", "{}"),
       R"(scene.json:3:17 /cell_types: is empty: kinds of cells by name; at least one)"},
      {"bad type name", minimal("\"hepatocyte\"", "\"a/b\""),
       R"(scene.json:3:18 /cell_types/a~1b: must be a name of letters, digits, _ and -)"},
      {"two types, none chosen", minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"),
       R"(scene.json:4:38 /cells/list/0/type: is missing: there are 2 cell types: a, b)"},
      {"two types in a clump",
       changed(minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"), "\"cells\": {",
               R"("cells": {"source": "clump", )"),
       R"(scene.json:4:23 /cells/source = "clump": makes cells of one type, but there are 2 cell types. Use source "list" to mix types)"},
      {"wall normal", wall(R"({"normal": [0, 0, 0]})"),
       R"(scene.json:1:24 /walls/0/normal = [0, 0, 0]: must not be zero: it is the direction of the plane's normal)"},
      {"wall that moves nowhere", wall(R"({"speed": "1 um/h"})"),
       R"(scene.json:1:23 /walls/0/travel = "0 um": must be > 0 um for a wall that moves)"},
      {"wall names", wall(R"({"name": "a"}, {"name": "a"})"),
       R"(scene.json:1:37 /walls/1/name = "a": another wall has this name)"},
      {"crop",
       with_block(
           R"("vessels": {"crop": {"low": ["0 um", "3 um", "0 um"], "high": ["1 um", "2 um", "3 um"]}})"),
       R"(scene.json:1:40 /vessels/crop/low/1 = "3 um": must be below /vessels/crop/high/1 = "2 um")"},
      {"zoom box",
       zoomed(
           R"({"kind": "box", "low": ["0 um", "3 um", "0 um"], "high": ["1 um", "2 um", "3 um"]})"),
       R"(scene.json:1:44 /zoom/0/low/1 = "3 um": must be below /zoom/0/high/1 = "2 um")"},
      {"zoom half space",
       zoomed(R"({"kind": "half_space", "point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 0]})"),
       R"(scene.json:1:80 /zoom/0/normal = [0, 0, 0]: must not be zero: it is the direction of the plane's normal)"},
      {"zoom axis distance",
       zoomed(R"({"kind": "axis_distance", "min_distance": "50 um", "max_distance": "40 um"})"),
       R"(scene.json:1:54 /zoom/0/min_distance = "50 um": must be below /zoom/0/max_distance = "40 um")"},
      {"zoom sphere", zoomed(R"({"kind": "sphere"})"),
       R"(scene.json:1:12 /zoom/0/radius: is missing: radius of the sphere, e.g. "12 um" (acinus explain zoom.radius))"},
      {"zoom key of another kind", zoomed(R"({"kind": "all", "radius": "1 um"})"),
       R"(scene.json:1:38 /zoom/0/radius = "1 um": is used only with kind = sphere. Remove it)"},
      {"zoom kind", zoomed(R"({"kind": "ball", "radius": "1 um"})"),
       R"(scene.json:1:21 /zoom/0/kind = "ball": unknown choice. Did you mean "all"?)"},
      {"start-up radius", with_block(R"("start_up": {"enabled": true, "initial_radius": "12 um"})"),
       R"(scene.json:1:51 /start_up/initial_radius = "12 um": must be below /cell_types/hepatocyte/radius = "12 um": cells grow during start-up)"},
      {"lesion below the vein", with_block(R"("lobule": {"lesion_radius": "9 um"})"),
       R"(scene.json:1:31 /lobule/central_vein_radius = "10 um": must be below /lobule/lesion_radius = "9 um")"},
      {"lesion above the lobule", with_block(R"("lobule": {"lesion_radius": "300 um"})"),
       R"(scene.json:1:31 /lobule/lesion_radius = "300 um": must be below /lobule/radius = "280 um")"},
      {"nodes", minimal("\"hepatocyte\": {}", R"("hepatocyte": {"dcm": {"nodes": 100}})"),
       R"(scene.json:3:50 /cell_types/hepatocyte/dcm/nodes = 100: must be one of 42, 162, 642, 2562)"},
      {"noise grid", with_block(R"("motility": {"grid": "0 s"})"),
       R"(scene.json:1:24 /motility/grid = "0 s": must be > 0 s)"},
      {"capsule radii", with_block(R"("capsule": {"radius": "5 um", "min_radius": "6 um"})"),
       R"(scene.json:1:47 /capsule/min_radius = "6 um": must not exceed /capsule/radius = "5 um")"},
      {"capsule that shrinks to nothing",
       with_block(R"("capsule": {"radius": "5 um", "speed": "1 um/h"})"),
       R"(scene.json:1:42 /capsule/min_radius = "0 um": must be > 0 um for a capsule that shrinks)"},
      {"auto where there is none", minimal("\"2 h\"", "\"auto\""),
       R"(scene.json:2:19 /time/end = "auto": does not start with a number; needed a time, e.g. "24 h")"},
      {"unit where none belongs", minimal("\"2 h\"", R"("2 h", "max_move": "0.3 um")"),
       R"(scene.json:2:38 /time/max_move = "0.3 um": must be a plain number, without unit and quotes)"},
      {"block that is no block", with_block(R"("contact": 3)"),
       R"(scene.json:1:14 /contact = 3: must be a block, { ... })"},
      {"list that is no list", with_block(R"("walls": {})"),
       R"(scene.json:1:12 /walls = {}: must be a list, [ ... ])"},
      {"vector with two parts", with_block(R"("axis_point": ["0 um", "0 um"])"),
       R"(scene.json:1:17 /axis_point = ["0 um", "0 um"]: must be a list of three, e.g. ["12 um", "12 um", "12 um"])"},
      {"half a cell", with_block(R"("cells2": 0, "solver": {"max_iterations": 1.5})"),
       "scene.json:1:3 /cells2: unknown key. Did you mean \"cells\"? (acinus explain cells)\n"
       R"(scene.json:1:45 /solver/max_iterations = 1.5: must be a whole number, without quotes)"},
  };
  for (const BrokenRule& rule : rules) EXPECT_EQ(failure(rule.text), rule.message) << rule.name;
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
  EXPECT_EQ(scene({"walls=[{\"name\": \"w\"}]"}).walls[0].name, "w");
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
  EXPECT_NE(failure(kMinimal, {"extends=a.json"}).find("cannot be changed"), std::string::npos);
  EXPECT_NE(failure(kMinimal, {"name=\xFF"}).find("UTF-8"), std::string::npos);
  // Mistakes of the file come first, then those of the flags.
  const std::string both = failure(minimal("\"2 h\"", "\"2 h\", \"stp\": 1"), {"seed=-1"});
  EXPECT_LT(both.find("scene.json:2:26 /time/stp"), both.find("--set seed=-1: /seed = -1"));
}

TEST(SceneExtends, ObjectsAreMergedAndTheRestReplaced) {
  TemporaryFolder folder;
  folder.write("base/base.json", kFull);
  const std::string file = folder.write("top.json", R"({
  "extends": "base/base.json",
  "name": "top",
  "cell_types": {"old": {"dcm": {"nodes": 42}}},
  "zoom": [{"kind": "all"}],
  "lobule": {"height": "48 um"}
})");
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.name, "top");
  EXPECT_EQ(scene.cell_types.at("old").dcm.nodes, 42);
  EXPECT_EQ(scene.cell_types.at("old").dcm.cortex_young, 0.9);
  EXPECT_EQ(scene.zoom.size(), 1u);
  EXPECT_EQ(scene.lobule->height, 48);
  EXPECT_EQ(scene.walls.size(), 2u);
}

std::string file_failure(const std::string& file, const std::vector<std::string>& set = {}) {
  try {
    read_scene(file, set);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneExtends, ErrorsNameTheFileTheyStandIn) {
  TemporaryFolder folder;
  const std::string base = folder.write("base/base.json", minimal("\"2 h\"", "\"2 kPa\""));
  const std::string top =
      folder.write("top.json", "{\"extends\": \"base/base.json\",\n\"seed\": 1.5}");
  const std::string message = file_failure(top);
  EXPECT_EQ(message.find(top + ":2:9 /seed = 1.5"), 0u) << message;
  EXPECT_NE(message.find("\n" + base + ":2:19 /time/end = \"2 kPa\""), std::string::npos)
      << message;
}

TEST(SceneExtends, CirclesAndMissingFilesAreRefused) {
  TemporaryFolder folder;
  const std::string a = folder.write("a.json", R"({"extends": "b.json"})");
  const std::string b = folder.write("b.json", R"({"extends": "./a.json"})");
  EXPECT_EQ(file_failure(a), b + ":1:13 /extends = \"./a.json\": the files extend each other in a "
                                 "circle");
  const std::string self = folder.write("self.json", R"({"extends": "self.json"})");
  EXPECT_NE(file_failure(self).find("circle"), std::string::npos);
  const std::string lost = folder.write("lost.json", R"({"extends": "no.json"})");
  EXPECT_NE(file_failure(lost).find(":1:13 /extends = \"no.json\": no such file: "),
            std::string::npos);
  EXPECT_NE(file_failure(folder.write("n.json", R"({"extends": 3})")).find("must be the path"),
            std::string::npos);
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
  EXPECT_EQ(again.sha, with_mesh.sha);
}

TEST(SceneFiles, UnreadableFilesAreFileErrors) {
  for (const std::string path : {"/no/such/file.json", "/tmp", "/dev/null"}) {
    try {
      read_scene(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Exit::kFileError) << path;
    }
  }
}

TEST(SceneFuzz, MutatedTextsNeverFailOtherwiseThanByError) {
  std::mt19937 random(20240607);
  const std::vector<std::string> originals{kMinimal, kFull};
  const std::string alphabet = "{}[]\",:/*\\0123456789eE+-. umhkPaN^_\n\xC3\xFF\x01";
  int n_valid = 0, n_error = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = originals[static_cast<std::size_t>(i) % 2];
    const auto place = [&](std::size_t size) {
      return std::uniform_int_distribution<std::size_t>(0, size - 1)(random);
    };
    for (std::size_t n = 1 + place(3); n > 0; --n) {
      const std::size_t at = place(text.size()), length = 1 + place(8);
      switch (place(4)) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(at, text.substr(at, length));
          break;
        case 2:
          text[at] = alphabet[place(alphabet.size())];
          break;
        default:
          text.insert(at, 1, alphabet[place(alphabet.size())]);
          break;
      }
    }
    try {
      const Scene scene = parse_scene(text, "scene.json");
      EXPECT_EQ(parse_scene(scene.resolved_json, "scene.json").sha, scene.sha) << text;
      ++n_valid;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++n_error;
    }
  }
  std::printf("2000 mutated scenes: %d errors, %d still valid\n", n_error, n_valid);
  EXPECT_EQ(n_valid + n_error, 2000);
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
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(explain_key("/cell_types/hepatocyte/radius"), text);
  EXPECT_EQ(explain_key("cell_types.<name>.radius"), text);
  EXPECT_NE(explain_key("viscosity").find("friction.viscosity"), std::string::npos);
  EXPECT_NE(explain_key("/cells/list/3/position").find("cells.list.<number>.position"), 0u - 1);
  try {
    explain_key("cell.raduis");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "no scene key \"cell.raduis\". Did you mean \"cell.radius\"? `acinus explain` lists "
              "all");
  }
  for (const char* query : {"", ".", "///", "<", "\x01"}) EXPECT_THROW(explain_key(query), Error);
}

TEST(Explain, MarkdownPageIsUpToDate) {
  std::ifstream file(ACINUS_SOURCE_DIR "/docs/scene_keys.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), explain_markdown())
      << "docs/scene_keys.md is stale: acinus explain --markdown > docs/scene_keys.md";
}

TEST(Schema, KnowsEveryKey) {
  const std::string schema = scene_schema();
  EXPECT_NE(schema.find("https://json-schema.org/draft/2020-12/schema"), std::string::npos);
  for (const Entry& entry : all_entries()) {
    const std::string name = entry.path.substr(entry.path.rfind('.') + 1);
    EXPECT_NE(schema.find("\"" + name + "\": {"), std::string::npos) << entry.path;
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
  EXPECT_EQ((scene.cells.list[1].position - scene.cells.list[0].position).norm(), 23.5);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").adhesion, 0.01);
  EXPECT_EQ(scene.time.end, 7200);
  EXPECT_FALSE(scene.start_up.enabled);
  EXPECT_FALSE(scene.motility.random);
}

TEST(ShippedScenes, CopiesStandAlone) {
  TemporaryFolder folder;
  const std::string target = (folder.path() / "mine").string();
  const std::vector<std::string> written = copy_scene("two_cells", target);
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(read_scene(written[0]).sha, read_scene(scene_folder() + "/two_cells.json").sha);
  EXPECT_THROW(copy_scene("two_cells", target), Error);
  EXPECT_THROW(copy_scene("two_cell", target + "2"), Error);
}

}  // namespace
}  // namespace acinus::runs
