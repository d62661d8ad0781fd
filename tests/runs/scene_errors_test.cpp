#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/json_text.hpp"
#include "tests/paths.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {

using namespace scene_texts;

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
            "tolerance, max_move, integrator, extrapolate, until_cells");
}

TEST(SceneErrors, QuantitiesThatNoTissueHasAreSlipsOfTheUnit) {
  for (const char* key : {R"("adhesion": "1e95 J/m^2")", R"("adhesion": "1e-40 J/m^2")",
                          R"("radius": "2 m")", R"("dcm": {"bulk_modulus": "1e20 Pa"})"}) {
    const std::string text =
        failure(minimal("\"hepatocyte\": {}", fmt::format("\"hepatocyte\": {{{}}}", key)));
    EXPECT_CONTAINS(text, "is no size of tissue: from 1e-15 to 1e");
    EXPECT_CONTAINS(text, "Check its unit");
  }
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

TEST(SceneErrors, AWallSaysIfItIsAMirror) {
  const auto wall = [](const std::string& body) { return with_block("\"walls\": [" + body + "]"); };
  const std::string missing =
      "/walls/0/mirror: is missing: true: a symmetry plane that stands for equal cells on the "
      "other "
      "side, without adhesion and friction; false: a plate with adhesion and friction of its own "
      "(acinus explain wall.mirror)";
  EXPECT_EQ(failure(wall("{}")), "scene.json:1:13 " + missing);
  EXPECT_EQ(failure(kMinimal, {"walls=[{}]"}), "--set walls=[{}]: " + missing);
  // One fault, not a second one on keys that depend on it.
  EXPECT_EQ(failure(wall(R"({"adhesion": "1e-5 J/m^2", "young": "600 Pa"})")),
            "scene.json:1:13 " + missing);
  EXPECT_EQ(failure(wall(R"({"mirror": "false"})")),
            R"(scene.json:1:24 /walls/0/mirror = "false": must be true or false, without quotes)");
  EXPECT_CONTAINS(failure(wall(R"({"mirror": true}, {"name": "b"})")),
                  "/walls/1/mirror: is missing");
  for (const char* body : {R"({"mirror": true})", R"({"mirror": false})"})
    EXPECT_EQ(failure(wall(body)), "") << body;
}

TEST(SceneErrors, MissingKeysAreNamed) {
  EXPECT_EQ(failure("{}"),
            "scene.json:1:1 /time/end: is missing: simulated time after t = 0, e.g. \"24 h\" "
            "(acinus explain time.end)\n"
            "scene.json:1:1 /cell_types: is missing: kinds of cells by name; at least one "
            "(acinus explain cell_types)\n"
            "scene.json:1:1 /cells/list: has no entry, but /cells/source = \"list\". Add cells, or "
            "take another source: clump, box, fill, lobule");
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
  const std::string comma = "Is there a comma missing here?";
  starts("{\n  \"name\": \"a\"\n  \"seed\": 1\n}",
         "scene.json:2:14 /: not valid JSON: unexpected string literal; expected '}'. " + comma);
  starts("{\n  \"time\": {} // so\n\n  /* then */ \"seed\": 1\n}",
         "scene.json:2:13 /: not valid JSON: unexpected string literal; expected '}'. " + comma);
  starts(
      "{\n  \"seeds\": [1\n 2]\n}",
      "scene.json:2:14 /seeds: not valid JSON: unexpected number literal; expected ']'. " + comma);
  starts("{\"walls\": [{} {}]}",
         "scene.json:1:14 /walls: not valid JSON: unexpected '{'; expected ']'. " + comma);
  EXPECT_EQ(failure("{\"seed\": 01}").find(comma), std::string::npos);
  EXPECT_EQ(failure("{\"seed\": 1").find(comma), std::string::npos);
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
  EXPECT_CONTAINS(failure(deep), "nested deeper than 64");
  std::string names = "{";
  for (int i = 0; i < 10001; ++i) names += "\"k" + std::to_string(i) + "\": 1, ";
  EXPECT_CONTAINS(failure(names), "more than 10000 names");
  std::string values = "{\"walls\": [";
  for (std::size_t i = 0; i <= kMaxValues; ++i) values += "1,";
  EXPECT_CONTAINS(failure(values), "values in one file");
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
  EXPECT_CONTAINS(message, "... and 301 more");
}

TEST(SceneErrors, Proliferation) {
  const auto faults = [](const std::string& rates, const std::string& more) {
    return failure(
        with_block(R"("life": {"proliferation": {"rates": [)" + rates + "]" + more + "}}"),
        {R"(cell_types.hepatocyte.cycle.time="24 h")"});
  };
  EXPECT_EQ(faults(R"({"rate": "1 1/h"})", ""), "");
  EXPECT_CONTAINS(faults(R"({"first_layer": 3, "last_layer": 2, "rate": "1 1/h"})", ""),
                  "/life/proliferation/rates/0/last_layer = 2: must not be below "
                  "/life/proliferation/rates/0/first_layer = 3");
  EXPECT_CONTAINS(faults(R"({"rate": "1 1/h", "from": "2 h", "until": "1 h"})", ""),
                  "/life/proliferation/rates/0/until = \"1 h\": must be after");
  EXPECT_CONTAINS(faults(R"({"rate": "1 1/h"})", R"(, "edge": "start")"), "needs a lobule block");
  EXPECT_CONTAINS(failure(with_block(R"("life": {"proliferation": {}})")),
                  "no cell type has a cycle");
}

TEST(SceneErrors, RulesOfLife) {
  const auto cell = [](const std::string& body) {
    return minimal(R"({"hepatocyte": {}})", R"({"hepatocyte": {)" + body + "}}");
  };
  const auto rule = [](const std::string& body) {
    return with_block(R"("life": {"rules": [{)" + body + "}]}");
  };
  const std::string at = "scene.json:3:", type = "/cell_types/hepatocyte/";
  EXPECT_EQ(failure(cell(R"("cycle": {"time": "24 h", "mitosis": "20 h"})")),
            at + "70 " + type + R"(cycle/mitosis = "20 h": must not exceed 16.8 h: mitosis is )" +
                "part of the cycle, and the shortest cycle drawn is " + type +
                R"(cycle/time = "24 h" minus three times )" + type + "cycle/spread = 0.1 of it");
  EXPECT_EQ(failure(cell(R"("cycle": {"mitosis": "20 h"})")), "") << "nothing to fit into";
  EXPECT_EQ(failure(cell(R"("cycle": {"spread": 0.31})")),
            at + "53 " + type + "cycle/spread = 0.31: must be from 0 to 0.3");
  EXPECT_EQ(failure(cell(R"("cycle": {"axis": "given"})")),
            at + "42 " + type +
                "cycle/direction: is missing: direction in which the cells divide, "
                "of any length (acinus explain cell.cycle.direction)");
  EXPECT_EQ(failure(cell(R"("cycle": {"axis": "given", "direction": [0, 0, 0]})")),
            at + "73 " + type +
                "cycle/direction = [0, 0, 0]: must not be zero: it is the direction "
                "in which cells divide");
  EXPECT_EQ(failure(cell(R"("cycle": {"direction": [0, 0, 1]})")),
            at + "56 " + type +
                "cycle/direction = [0, 0, 1]: is used only with axis = given. "
                "Remove it");
  EXPECT_EQ(failure(cell(R"("cycle": {"time": "1 day", "axis": "vessel"})")),
            at + "68 " + type +
                R"(cycle/axis = "vessel": needs vessels: give /vessels/file or a )"
                "lobule block");
  EXPECT_NE(failure(R"({"vessels": {"center": true}})").find("give /vessels/file"),
            std::string::npos);
  EXPECT_EQ(failure(cell(R"("inhibition": {"by": "pressure"})")),
            at + "47 " + type +
                "inhibition/pressure_threshold: is missing: contact pressure that "
                "halves the growth rate; contact pressures are 0.04 to 2.4 Pa in tissue that "
                "grows freely, 5 to 300 Pa in a capsule that shrinks, "
                "e.g. \"1 kPa\" (acinus explain cell.inhibition.pressure_threshold)");
  EXPECT_EQ(failure(cell(R"("inhibition": {"by": "volume", "volume_threshold": "0.8"})")),
            at + "84 " + type +
                "inhibition/volume_threshold = \"0.8\": must be a plain number, without unit and "
                "quotes: volume, relative to the volume at rest, that halves the growth rate");
  EXPECT_EQ(failure(cell(R"("death": {"softening": 0.5})")),
            at + "56 " + type + "death/softening = 0.5: is used only with mode = lysis. Remove it");
  EXPECT_EQ(failure(cell(R"("death": {"mode": "lysis", "final_volume": 1})")),
            at + "76 " + type + "death/final_volume = 1: must be > 0 and < 1");
  EXPECT_EQ(
      failure(rule("")),
      "scene.json:1:22 /life/rules/0/do: is missing: rest: the cells do not grow while the "
      "rule holds for them; die: they die as soon as it holds (acinus explain life.rules.do)");
  EXPECT_EQ(failure(rule(R"("do": "rest", "from": "2 h", "until": "60 min")")),
            R"(scene.json:1:61 /life/rules/0/until = "60 min": must be after /life/rules/0/from = )"
            R"("2 h")");
  EXPECT_EQ(
      failure(rule(R"("do": "rest", "cells": [0, -1, 1.5, "2"])")),
      "scene.json:1:50 /life/rules/0/cells/1 = -1: must be >= 0\n"
      "scene.json:1:54 /life/rules/0/cells/2 = 1.5: must be a whole number, without quotes\n"
      "scene.json:1:59 /life/rules/0/cells/3 = \"2\": must be a whole number, without quotes");
  EXPECT_EQ(
      failure(rule(R"("do": "rest", "cells": 3)")),
      "scene.json:1:46 /life/rules/0/cells = 3: must be a list of whole numbers, e.g. [0, 1]");
  EXPECT_EQ(failure(rule(R"("do": "rest", "region": {"kind": "half_space", )"
                         R"("point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 0]})")),
            "scene.json:1:115 /life/rules/0/region/normal = [0, 0, 0]: must not be zero: it is the "
            "direction of the plane's normal");
  EXPECT_EQ(failure(rule(R"("do": "rest", "region": {"radius": "3 um"})")),
            "scene.json:1:47 /life/rules/0/region/kind: is missing: shape of the region; a cell is "
            "in it with its centre (acinus explain life.rules.region.kind)");
}

TEST(SceneErrors, OnlyOneIntegratorFollowsLife) {
  const std::string growing =
      minimal(R"({"hepatocyte": {}})", R"({"hepatocyte": {"cycle": {"time": "24 h"}}})");
  for (const char* name : {"explicit-euler", "newton"}) {
    const std::string integrator = std::string("time.integrator=") + name;
    EXPECT_EQ(failure(growing, {integrator}),
              "--set " + integrator + ": /time/integrator = \"" + name +
                  "\": cannot follow cells that grow, divide or die "
                  "(/cell_types/hepatocyte/cycle/time). Choose \"linearly-implicit\"");
    EXPECT_CONTAINS(failure(kMinimal, {integrator, R"(life.rules=[{"do": "die"}])"}),
                    "(/life/rules/0/do)");
    EXPECT_EQ(failure(kMinimal, {integrator}), "");
  }
  EXPECT_EQ(failure(growing), "");
}

TEST(SceneErrors, OnlyWallsThatAreNoMirrorsAdhere) {
  const auto wall = [](const std::string& body) { return with_block("\"walls\": [" + body + "]"); };
  EXPECT_EQ(failure(wall(R"({"adhesion": "1e-5 J/m^2", "mirror": true})")),
            R"(scene.json:1:26 /walls/0/adhesion = "1e-5 J/m^2": a mirror wall stands for equal )"
            R"(cells and does not adhere. Set /walls/0/mirror to false)");
  EXPECT_EQ(failure(wall(R"({"young": "600 Pa", "mirror": true})")),
            R"(scene.json:1:23 /walls/0/young = "600 Pa": is used only with mirror = false. )"
            "Remove it");
  EXPECT_EQ(failure(wall(R"({"mirror": false, "adhesion": "1e-5 J/m^2", "young": "600 Pa"})")), "");
}

TEST(SceneErrors, ModelZoomFromOutsideNeedsRegions) {
  EXPECT_EQ(failure(kMinimal, {"model=zoom"}),
            "--set model=zoom: /model = \"zoom\": needs at least one region in /zoom. Add one, or "
            "choose \"dcm\" or \"cbm\"");
  EXPECT_EQ(failure(kMinimal, {"model=cmb"}),
            "--set model=cmb: /model = \"cmb\": unknown choice. Did you mean \"cbm\"?");
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
       R"(scene.json:2:34 /time/step = "1 s": must not be below /time/min_step = "2 s". )"
       R"(Raise step or lower min_step)"},
      {"default step below min_step", minimal("\"2 h\"", R"("2 h", "min_step": "70 s")"),
       R"(scene.json:2:38 /time/step = "60 s": must not be below /time/min_step = "70 s". )"
       R"(Raise step or lower min_step)"},
      {"skin", with_block(R"("contact": {"skin": "0 um"})"),
       R"(scene.json:1:23 /contact/skin = "0 um": must be > 0 um)"},
      {"zoom without its model", with_block(R"("zoom": [{"kind": "all"}])"),
       R"(scene.json:1:11 /zoom = [{...}]: zoom regions need /cells/model = "zoom", not )"
       R"("dcm". Remove the regions (--set zoom=[]) or change the model)"},
      {"model zoom without regions", minimal("\"dcm\"", "\"zoom\""),
       R"(scene.json:4:22 /cells/model = "zoom": needs at least one region in /zoom. Add )"
       R"(one, or choose "dcm" or "cbm")"},
      {"lobule cells without lobule", minimal("\"cells\": {", R"("cells": {"source": "lobule", )"),
       R"(scene.json:4:23 /cells/source = "lobule": needs a lobule block (acinus explain lobule))"},
      {"lobule experiment without lobule", with_block(R"("experiment": "lobule")"),
       R"(scene.json:1:17 /experiment = "lobule": needs a lobule block (acinus explain lobule))"},
      {"empty list", minimal("[{\"position\": [\"0 um\", \"0 um\", \"0 um\"]}]", "[]"),
       R"(scene.json:4:37 /cells/list = []: has no entry, but /cells/source = "list". Add )"
       R"(cells, or take another source: clump, box, fill, lobule)"},
      {"no cell type", minimal("{\"hepatocyte\": {}}", "{}"),
       R"(scene.json:3:17 /cell_types: is empty: kinds of cells by name; at least one)"},
      {"bad type name", minimal("\"hepatocyte\"", "\"a/b\""),
       R"(scene.json:3:18 /cell_types/a~1b: must be a name of letters, digits, _ and -)"},
      {"two types, none chosen", minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"),
       R"(scene.json:4:38 /cells/list/0/type: is missing: there are 2 cell types: a, b)"},
      {"two types in a clump",
       changed(minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"), "\"cells\": {",
               R"("cells": {"source": "clump", )"),
       R"(scene.json:4:23 /cells/types: is empty, but there are 2 cell types: a, b. Say which )"
       R"(cells of source "clump" are of which, or take one out)"},
      {"types of a list",
       minimal("\"cells\": {", R"("cells": {"types": [{"type": "hepatocyte"}], )"),
       R"(scene.json:4:22 /cells/types = [{...}]: is for cells that are not listed: with )"
       R"(/cells/source = "list" every cell names its type)"},
      {"unknown type of a share",
       minimal("\"cells\": {", R"("cells": {"source": "box", "types": [{"type": "hepatozyte"}], )"),
       R"(scene.json:4:49 /cells/types/0/type = "hepatozyte": unknown cell type. Did you mean )"
       R"("hepatocyte"?)"},
      {"no type for cells in no region",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte", "region": {"kind": )"
               R"("sphere", "radius": "9 um"}}], )"),
       R"(scene.json:4:39 /cells/types = [{...}]: needs an entry without a region, for cells )"
       R"(that are in none)"},
      {"region of a type",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte"}, )"
               R"({"type": "hepatocyte", "region": {"kind": "half_space", "point": )"
               R"(["0 um", "0 um", "0 um"], "normal": [0, 0, 0]}}], )"),
       R"(scene.json:4:165 /cells/types/1/region/normal = [0, 0, 0]: must not be zero: it is the )"
       R"(direction of the plane's normal)"},
      {"share of a type",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte", "share": 0}], )"),
       R"(scene.json:4:72 /cells/types/0/share = 0: must be > 0)"},
      {"relaxation of what is never let go", with_block(R"("experiment": "relaxation")"),
       R"(scene.json:1:17 /experiment = "relaxation": needs a wall or a capsule that opens )"
       R"(before /time/end (acinus explain wall.opens))"},
      {"wall normal", wall(R"({"normal": [0, 0, 0], "mirror": true})"),
       R"(scene.json:1:24 /walls/0/normal = [0, 0, 0]: must not be zero: it is the )"
       R"(direction of the plane's normal)"},
      {"wall that moves nowhere", wall(R"({"speed": "1 um/h", "mirror": true})"),
       R"(scene.json:1:23 /walls/0/travel = "0 um": must be > 0 um for a wall that moves)"},
      {"wall names", wall(R"({"name": "a", "mirror": true}, {"name": "a", "mirror": true})"),
       R"(scene.json:1:53 /walls/1/name = "a": another wall has this name)"},
      {"crop",
       with_block(R"("vessels": {"crop": [["0 um", "3 um", "0 um"], ["1 um", "2 um", "3 um"]], )"
                  R"("file": ")" +
                  test::data_path("files/capillaries.vtk") + R"("})"),
       R"(scene.json:1:33 /vessels/crop/0/1 = "3 um": must be below )"
       R"(/vessels/crop/1/1 = "2 um")"},
      {"half a crop", with_block(R"("vessels": {"crop": [1]})"),
       "scene.json:1:23 /vessels/crop = [1]: must be a list of two corners, the lower one first"},
      {"wall name", wall(R"({"name": "a/b", "mirror": true})"),
       R"(scene.json:1:22 /walls/0/name = "a/b": must be a name of letters, digits, _ and -, )"
       "with spaces inside if wanted"},
      {"zoom box",
       zoomed(
           R"({"kind": "box", "low": ["0 um", "3 um", "0 um"], "high": ["1 um", "2 um", "3 um"]})"),
       R"(scene.json:1:44 /zoom/0/low/1 = "3 um": must be below /zoom/0/high/1 = "2 um")"},
      {"zoom half space",
       zoomed(R"({"kind": "half_space", "point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 0]})"),
       R"(scene.json:1:80 /zoom/0/normal = [0, 0, 0]: must not be zero: it is the )"
       R"(direction of the plane's normal)"},
      {"zoom axis distance",
       zoomed(R"({"kind": "axis_distance", "min_distance": "50 um", "max_distance": "40 um"})"),
       R"(scene.json:1:54 /zoom/0/min_distance = "50 um": must be below )"
       R"(/zoom/0/max_distance = "40 um")"},
      {"zoom sphere", zoomed(R"({"kind": "sphere"})"),
       R"(scene.json:1:12 /zoom/0/radius: is missing: radius of the sphere, e.g. "12 um" )"
       R"((acinus explain zoom.radius))"},
      {"zoom key of another kind", zoomed(R"({"kind": "all", "radius": "1 um"})"),
       R"(scene.json:1:38 /zoom/0/radius = "1 um": is used only with kind = sphere. Remove it)"},
      {"zoom kind", zoomed(R"({"kind": "ball", "radius": "1 um"})"),
       R"(scene.json:1:21 /zoom/0/kind = "ball": unknown choice. Did you mean "all"?)"},
      {"start-up radius", with_block(R"("start_up": {"enabled": true, "initial_radius": "12 um"})"),
       R"(scene.json:1:51 /start_up/initial_radius = "12 um": must be below )"
       R"(/cell_types/hepatocyte/radius = "12 um": cells grow during start-up)"},
      {"lesion below the vein", with_block(R"("lobule": {"lesion_radius": "9 um"})"),
       R"(scene.json:1:31 /lobule/central_vein_radius = "10 um": must be below )"
       R"(/lobule/lesion_radius = "9 um")"},
      {"lesion above the lobule", with_block(R"("lobule": {"lesion_radius": "300 um"})"),
       R"(scene.json:1:31 /lobule/lesion_radius = "300 um": must be below /lobule/radius )"
       R"(= "280 um")"},
      {"fill box",
       minimal("\"cells\": {", R"("cells": {"source": "fill", "low": ["0 um", "0 um", "0 um"], )"
                               R"("high": ["9 um", "9 um", "0 um"], )"),
       R"(scene.json:4:55 /cells/low/2 = "0 um": must be below /cells/high/2 = "0 um")"},
      {"fill without box", minimal("\"cells\": {", R"("cells": {"source": "fill", )"),
       "scene.json:4:12 /cells/low: is missing: low corner of the box that random cells fill, "
       "e.g. \"12 um\" (acinus explain cells.low)\n"
       "scene.json:4:12 /cells/high: is missing: high corner of the box that random cells fill, "
       "e.g. \"12 um\" (acinus explain cells.high)"},
      {"nodes", minimal("\"hepatocyte\": {}", R"("hepatocyte": {"dcm": {"nodes": 100}})"),
       R"(scene.json:3:50 /cell_types/hepatocyte/dcm/nodes = 100: must be one of 42, 92, )"
       R"(162, 252, 362, 642, 1442, 2562)"},
      {"noise grid", with_block(R"("motility": {"grid": "0 s"})"),
       R"(scene.json:1:24 /motility/grid = "0 s": must be > 0 s)"},
      {"capsule radii", with_block(R"("capsule": {"radius": "5 um", "min_radius": "6 um"})"),
       R"(scene.json:1:47 /capsule/min_radius = "6 um": must not exceed /capsule/radius = "5 um")"},
      {"capsule that shrinks to nothing",
       with_block(R"("capsule": {"radius": "5 um", "speed": "1 um/h"})"),
       R"(scene.json:1:42 /capsule/min_radius = "0 um": must be > 0 um for a capsule that )"
       R"(shrinks)"},
      {"auto where there is none", minimal("\"2 h\"", "\"auto\""),
       R"(scene.json:2:19 /time/end = "auto": does not start with a number; needed a )"
       R"(time, e.g. "24 h")"},
      {"unit where none belongs", minimal("\"2 h\"", R"("2 h", "max_move": "0.3 um")"),
       R"(scene.json:2:38 /time/max_move = "0.3 um": must be a plain number, without unit )"
       R"(and quotes: farthest a node may move in one step, in mean edge lengths; 0 = no cap)"},
      {"block that is no block", with_block(R"("contact": 3)"),
       R"(scene.json:1:14 /contact = 3: must be a block, { ... })"},
      {"list that is no list", with_block(R"("walls": {})"),
       R"(scene.json:1:12 /walls = {}: must be a list, [ ... ])"},
      {"vector with two parts", with_block(R"("axis_point": ["0 um", "0 um"])"),
       R"(scene.json:1:17 /axis_point = ["0 um", "0 um"]: must be a list of three, e.g. )"
       R"(["12 um", "12 um", "12 um"])"},
      {"half a cell", with_block(R"("cells2": 0, "solver": {"max_iterations": 1.5})"),
       "scene.json:1:3 /cells2: unknown key. Did you mean \"cells\"? (acinus explain cells)\n"
       R"(scene.json:1:45 /solver/max_iterations = 1.5: must be a whole number, without quotes)"},
  };
  for (const BrokenRule& rule : rules) EXPECT_EQ(failure(rule.text), rule.message) << rule.name;
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
      EXPECT_EQ(parse_scene(scene.resolved_json, "scene.json").hash, scene.hash) << text;
      ++n_valid;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++n_error;
    }
  }
  std::printf("2000 mutated scenes: %d errors, %d still valid\n", n_error, n_valid);
  EXPECT_EQ(n_valid + n_error, 2000);
}

}  // namespace
}  // namespace acinus::runs
