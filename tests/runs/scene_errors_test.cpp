#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "runs/scene/json_text.hpp"
#include "runs/scene/reader.hpp"
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

TEST(SceneErrors, MissingKeysAreNamed) {
  EXPECT_EQ(failure("{}"),
            "scene.json:1:1 /time/end: is missing: simulated time after t = 0, e.g. \"24 h\" "
            "(acinus explain time.end)\n"
            "scene.json:1:1 /cell_types: is missing: kinds of cells by name; at least one "
            "(acinus explain cell_types)\n"
            "scene.json:1:1 /cells/list: has no entry, but /cells/source = \"list\". Add cells, or "
            "take another source: clump, box, fill, lobule\n"
            "scene.json:1:1 /cells/model = \"zoom\": needs at least one region in /zoom. Add one, "
            "or choose \"dcm\" or \"cbm\"");
  EXPECT_CONTAINS(failure(minimal("\"position\": [\"0 um\", \"0 um\", \"0 um\"]", "")),
                  R"(/cells/list/0/position: is missing: centre of the cell, e.g. "12 um")");
  EXPECT_CONTAINS(failure(with_block(R"("capsule": {})")),
                  R"(/capsule/radius: is missing: inner radius at t = 0, e.g. "12 um")");
}

TEST(SceneErrors, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(failure(minimal("{\"end\"", "/* \xC3\xA4\xE2\x82\xAC */ {\"raduis\": 1, \"end\""))
                .substr(0, 35),
            "scene.json:2:21 /time/raduis: unkno");
}

TEST(SceneErrors, DuplicateKeysAreRefused) {
  EXPECT_CONTAINS(failure(minimal("\"2 h\"", "\"2 h\",\n    \"end\": \"3 h\"")),
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
  EXPECT_CONTAINS(failure(std::string(100000, '[')),
                  "scene.json:1:65 /: nested deeper than 64 levels");
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
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"time": "24 h", "mitosis": "20 h"})")),
                  R"(cycle/mitosis = "20 h": must not exceed 16.8 h, the shortest cycle)");
  EXPECT_EQ(failure(cell(R"("cycle": {"mitosis": "20 h"})")), "")
      << "no cycle, nothing to fit into";
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"spread": 0.31})")),
                  "cycle/spread = 0.31: must be from 0 to 0.3");
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"axis": "given"})")), "cycle/direction: is missing");
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"axis": "given", "direction": [0, 0, 0]})")),
                  "cycle/direction = [0, 0, 0]: must not be zero");
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"direction": [0, 0, 1]})")),
                  "cycle/direction = [0, 0, 1]: is used only with ... Remove it");
  EXPECT_CONTAINS(failure(cell(R"("cycle": {"time": "1 day", "axis": "vessel"})")),
                  R"(cycle/axis = "vessel": needs vessels: give /vessels/file or a lobule)");
  EXPECT_CONTAINS(failure(R"({"vessels": {"center": true}})"), "give /vessels/file");
  EXPECT_CONTAINS(failure(cell(R"("inhibition": {"by": "pressure"})")),
                  "inhibition/pressure_threshold: is missing");
  EXPECT_CONTAINS(failure(cell(R"("inhibition": {"by": "volume", "volume_threshold": "0.8"})")),
                  R"(inhibition/volume_threshold = "0.8": must be a plain number)");
  EXPECT_CONTAINS(failure(cell(R"("death": {"softening": 0.5})")),
                  "death/softening = 0.5: is used only with mode ... Remove it");
  EXPECT_CONTAINS(failure(cell(R"("death": {"mode": "lysis", "final_volume": 1})")),
                  "death/final_volume = 1: must be > 0 and < 1");
  EXPECT_CONTAINS(failure(rule("")), "/life/rules/0/do: is missing");
  EXPECT_CONTAINS(failure(rule(R"("do": "rest", "from": "2 h", "until": "60 min")")),
                  R"(/life/rules/0/until = "60 min": must be after /life/rules/0/from = "2 h")");
  EXPECT_EQ(
      failure(rule(R"("do": "rest", "cells": [0, -1, 1.5, "2"])")),
      "scene.json:1:50 /life/rules/0/cells/1 = -1: must be >= 0\n"
      "scene.json:1:54 /life/rules/0/cells/2 = 1.5: must be a whole number, without quotes\n"
      "scene.json:1:59 /life/rules/0/cells/3 = \"2\": must be a whole number, without quotes");
  EXPECT_CONTAINS(failure(rule(R"("do": "rest", "cells": 3)")),
                  "/life/rules/0/cells = 3: must be a list of whole numbers, e.g. [0, 1]");
  EXPECT_CONTAINS(failure(rule(R"("do": "rest", "region": {"kind": "half_space", )"
                               R"("point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 0]})")),
                  "/life/rules/0/region/normal = [0, 0, 0]: must not be zero");
  EXPECT_CONTAINS(failure(rule(R"("do": "rest", "region": {"radius": "3 um"})")),
                  "/life/rules/0/region/kind: is missing");
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
  EXPECT_CONTAINS(failure(wall(R"({"adhesion": "1e-5 J/m^2"})")),
                  "/walls/0/adhesion ... a mirror wall ... Set /walls/0/mirror to false");
  EXPECT_CONTAINS(failure(wall(R"({"young": "600 Pa"})")),
                  R"(/walls/0/young = "600 Pa": is used only with mirror = false. Remove it)");
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
  const BrokenRule rules[] = {
      {"step below min_step", minimal("\"2 h\"", R"("2 h", "step": "1 s", "min_step": "2 s")"),
       R"(/time/step = "1 s": must not be below /time/min_step = ... Raise step or lower)"},
      {"default step below min_step", minimal("\"2 h\"", R"("2 h", "min_step": "70 s")"),
       R"(/time/step = "60 s": must not be below /time/min_step = ... Raise step or lower)"},
      {"skin", with_block(R"("contact": {"skin": "0 um"})"),
       R"(/contact/skin = "0 um": must be > 0 um)"},
      {"zoom without its model", with_block(R"("zoom": [{"kind": "all"}])"),
       "/zoom = [{...}]: zoom regions need /cells/model = ... Remove the regions (--set"},
      {"model zoom without regions", minimal("\"dcm\"", "\"zoom\""),
       R"(/cells/model = "zoom": needs at least one region ... Add one, or choose "dcm")"},
      {"lobule cells without lobule", minimal("\"cells\": {", R"("cells": {"source": "lobule", )"),
       R"(/cells/source = "lobule": needs a lobule block)"},
      {"lobule experiment without lobule", with_block(R"("experiment": "lobule")"),
       R"(/experiment = "lobule": needs a lobule block)"},
      {"empty list", minimal("[{\"position\": [\"0 um\", \"0 um\", \"0 um\"]}]", "[]"),
       "/cells/list = []: has no entry, but /cells/source ... clump, box, fill, lobule"},
      {"no cell type", minimal("{\"hepatocyte\": {}}", "{}"),
       "/cell_types: is empty: kinds of cells by name; at least one"},
      {"bad type name", minimal("\"hepatocyte\"", "\"a/b\""),
       "/cell_types/a~1b: must be a name of letters, digits, _ and -"},
      {"two types, none chosen", minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"),
       "/cells/list/0/type: is missing: there are 2 cell types: a, b"},
      {"two types in a clump",
       changed(minimal("\"hepatocyte\": {}", R"("a": {}, "b": {})"), "\"cells\": {",
               R"("cells": {"source": "clump", )"),
       "/cells/types: is empty, but there are 2 cell types: a, b"},
      {"types of a list",
       minimal("\"cells\": {", R"("cells": {"types": [{"type": "hepatocyte"}], )"),
       "/cells/types = [{...}]: is for cells that are not listed"},
      {"unknown type of a share",
       minimal("\"cells\": {", R"("cells": {"source": "box", "types": [{"type": "hepatozyte"}], )"),
       R"(/cells/types/0/type = "hepatozyte": unknown cell type. Did you mean "hepatocyte"?)"},
      {"no type for cells in no region",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte", "region": {"kind": )"
               R"("sphere", "radius": "9 um"}}], )"),
       "/cells/types = [{...}]: needs an entry without a region, for cells that"},
      {"region of a type",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte"}, )"
               R"({"type": "hepatocyte", "region": {"kind": "half_space", "point": )"
               R"(["0 um", "0 um", "0 um"], "normal": [0, 0, 0]}}], )"),
       "/cells/types/1/region/normal = [0, 0, 0]: must not be zero"},
      {"share of a type",
       minimal("\"cells\": {",
               R"("cells": {"source": "box", "types": [{"type": "hepatocyte", "share": 0}], )"),
       "/cells/types/0/share = 0: must be > 0"},
      {"relaxation of what is never let go", with_block(R"("experiment": "relaxation")"),
       R"(/experiment = "relaxation": needs a wall or a capsule that opens before)"},
      {"wall normal", wall(R"({"normal": [0, 0, 0]})"),
       "/walls/0/normal = [0, 0, 0]: must not be zero"},
      {"wall that moves nowhere", wall(R"({"speed": "1 um/h"})"),
       R"(/walls/0/travel = "0 um": must be > 0 um for a wall that moves)"},
      {"wall names", wall(R"({"name": "a"}, {"name": "a"})"),
       R"(/walls/1/name = "a": another wall has this name)"},
      {"crop",
       with_block(R"("vessels": {"crop": [["0 um", "3 um", "0 um"], ["1 um", "2 um", "3 um"]], )"
                  R"("file": ")" +
                  test::data_path("files/capillaries.vtk") + R"("})"),
       R"(/vessels/crop/0/1 = "3 um": must be below /vessels/crop/1/1 = "2 um")"},
      {"half a crop", with_block(R"("vessels": {"crop": [1]})"),
       "/vessels/crop = [1]: must be a list of two corners, the lower one first"},
      {"wall name", wall(R"({"name": "a/b"})"),
       R"(/walls/0/name = "a/b": must be a name of letters, digits, _ and -, with)"},
      {"zoom box",
       zoomed(
           R"({"kind": "box", "low": ["0 um", "3 um", "0 um"], "high": ["1 um", "2 um", "3 um"]})"),
       R"(/zoom/0/low/1 = "3 um": must be below /zoom/0/high/1 = "2 um")"},
      {"zoom half space",
       zoomed(R"({"kind": "half_space", "point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 0]})"),
       "/zoom/0/normal = [0, 0, 0]: must not be zero"},
      {"zoom axis distance",
       zoomed(R"({"kind": "axis_distance", "min_distance": "50 um", "max_distance": "40 um"})"),
       R"(/zoom/0/min_distance = "50 um": must be below /zoom/0/max_distance = "40 um")"},
      {"zoom sphere", zoomed(R"({"kind": "sphere"})"),
       R"(/zoom/0/radius: is missing: radius of the sphere, e.g. "12 um")"},
      {"zoom key of another kind", zoomed(R"({"kind": "all", "radius": "1 um"})"),
       R"(/zoom/0/radius = "1 um": is used only with kind = sphere. Remove it)"},
      {"zoom kind", zoomed(R"({"kind": "ball", "radius": "1 um"})"),
       R"(/zoom/0/kind = "ball": unknown choice. Did you mean "all"?)"},
      {"start-up radius", with_block(R"("start_up": {"enabled": true, "initial_radius": "12 um"})"),
       R"(/start_up/initial_radius = "12 um": must be below /cell_types/hepatocyte/radius)"},
      {"lesion below the vein", with_block(R"("lobule": {"lesion_radius": "9 um"})"),
       R"(/lobule/central_vein_radius = "10 um": must be below /lobule/lesion_radius)"},
      {"lesion above the lobule", with_block(R"("lobule": {"lesion_radius": "300 um"})"),
       R"(/lobule/lesion_radius = "300 um": must be below /lobule/radius = "280 um")"},
      {"fill box",
       minimal("\"cells\": {", R"("cells": {"source": "fill", "low": ["0 um", "0 um", "0 um"], )"
                               R"("high": ["9 um", "9 um", "0 um"], )"),
       R"(/cells/low/2 = "0 um": must be below /cells/high/2 = "0 um")"},
      {"fill without box", minimal("\"cells\": {", R"("cells": {"source": "fill", )"),
       "/cells/low: is missing ... /cells/high: is missing"},
      {"nodes", minimal("\"hepatocyte\": {}", R"("hepatocyte": {"dcm": {"nodes": 100}})"),
       "/cell_types/hepatocyte/dcm/nodes = 100: must be one of 42, 92, 162, 252"},
      {"noise grid", with_block(R"("motility": {"grid": "0 s"})"),
       R"(/motility/grid = "0 s": must be > 0 s)"},
      {"capsule radii", with_block(R"("capsule": {"radius": "5 um", "min_radius": "6 um"})"),
       R"(/capsule/min_radius = "6 um": must not exceed /capsule/radius = "5 um")"},
      {"capsule that shrinks to nothing",
       with_block(R"("capsule": {"radius": "5 um", "speed": "1 um/h"})"),
       R"(/capsule/min_radius = "0 um": must be > 0 um for a capsule that shrinks)"},
      {"auto where there is none", minimal("\"2 h\"", "\"auto\""),
       R"(/time/end = "auto": does not start with a number; needed a time, e.g. "24 h")"},
      {"unit where none belongs", minimal("\"2 h\"", R"("2 h", "max_move": "0.3 um")"),
       R"(/time/max_move = "0.3 um": must be a plain number, without unit and quotes)"},
      {"block that is no block", with_block(R"("contact": 3)"),
       "/contact = 3: must be a block, { ... }"},
      {"list that is no list", with_block(R"("walls": {})"),
       "/walls = {}: must be a list, [ ... ]"},
      {"vector with two parts", with_block(R"("axis_point": ["0 um", "0 um"])"),
       R"(/axis_point = ["0 um", "0 um"]: must be a list ... ["12 um", "12 um", "12 um"])"},
      {"half a cell", with_block(R"("cells2": 0, "solver": {"max_iterations": 1.5})"),
       R"(/cells2: unknown key. Did you mean "cells"? ... /solver/max_iterations = 1.5: must be a whole)"},
  };
  for (const BrokenRule& rule : rules)
    EXPECT_CONTAINS(failure(rule.text), rule.message) << rule.name;
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
