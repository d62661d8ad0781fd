/// Effects of keys: on resumed runs, shared starts, comparisons, laws and dissolving cells. Their
/// explanation.

#include "runs/scene/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "runs/assemble/law_parameters.hpp"
#include "runs/assemble/start_state.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/entries.hpp"
#include "runs/scene/explain.hpp"
#include "runs/scene/key_values.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "tests/messages.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

bool is_number(const Entry& e) {
  return e.type == "quantity" || e.type == "number" || e.type == "whole number";
}

TEST(Registry, EffectsOfEveryKeyGoTogether) {
  std::set<std::string> constants;
  for (const Entry& e : all_entries()) {
    const bool constant = e.in_law != InLaw::kNo && e.in_law != InLaw::kSetting;
    EXPECT_EQ(constant, !e.law_name.empty()) << e.path;
    if (constant) {
      EXPECT_TRUE(is_number(e)) << e.path;
      EXPECT_TRUE(constants.insert(e.law_name).second) << e.path << ": another key's constant";
    }
    const bool of_cells = e.path.starts_with("cell_types.<name>.");
    if (e.in_law != InLaw::kNo) {
      EXPECT_TRUE(of_cells || e.path.starts_with("contact.")) << e.path << ": is never collected";
      EXPECT_EQ(e.condition, "") << e.path << ": would be missing where the condition fails";
    }
    if (e.softens) {
      EXPECT_TRUE(of_cells && e.type == "quantity" && constant) << e.path;
    }
    if (e.affects == Affects::kAges) {
      EXPECT_TRUE(of_cells) << e.path;
    }
    if (e.affects == Affects::kNothing) {
      EXPECT_FALSE(is_number(e) || e.is_block) << e.path << ": without an effect";
    }
  }
  EXPECT_EQ(constants.size(), 13u);
}

TEST(Registry, KeysTakeEffectsOverFromTheirBlock) {
  const auto affects = [](const char* path) { return find_entry(path)->affects; };
  EXPECT_EQ(affects("/time/step"), Affects::kStep) << "block time";
  EXPECT_EQ(affects("/time/end"), Affects::kOutput) << "its own";
  EXPECT_EQ(affects("/output/every"), Affects::kOutput);
  EXPECT_EQ(affects("/life/rules/3/share"), Affects::kStep) << "through a list";
  EXPECT_EQ(affects("/cell_types/a/death/softening"), Affects::kStep) << "through a map";
  EXPECT_EQ(affects("/cell_types/a/cycle/time"), Affects::kAges);
  EXPECT_EQ(affects("/cell_types/a/cycle/start"), Affects::kStart);
  EXPECT_EQ(affects("/cells/list/12/radius"), Affects::kStart) << "of no block";
  EXPECT_EQ(affects("/seed"), Affects::kStart);
  const auto compared = [](const char* path) { return find_entry(path)->compared; };
  EXPECT_FALSE(compared("/cell_types/a/cbm/poisson"));
  EXPECT_TRUE(compared("/cell_types/cbm/radius")) << "a type of that name";
  EXPECT_TRUE(compared("/cell_types/cbm/dcm/nodes"));
  EXPECT_FALSE(compared("/friction/cbm_vessel"));
  EXPECT_TRUE(compared("/friction/dcm_vessel"));
  EXPECT_TRUE(compared("/moving_zoom/every"));
  EXPECT_FALSE(compared("/zoom/0/kind"));
}

TEST(Registry, FindsKeysByPath) {
  const auto path = [](const char* text) -> std::string {
    const Entry* e = find_entry(text);
    return e == nullptr ? "none" : e->path;
  };
  EXPECT_EQ(path("/cell_types/a-1/radius"), "cell_types.<name>.radius");
  EXPECT_EQ(path("cell_types.a.radius"), "cell_types.<name>.radius");
  EXPECT_EQ(path("cell_types.<name>.radius"), "cell_types.<name>.radius");
  EXPECT_EQ(path("/walls/10/point"), "walls.<number>.point");
  EXPECT_EQ(path("/walls"), "walls");
  for (const char* text :
       {"", "/", "/walls/a/point", "/walls/-1/point", "/walls/0", "/walls/0/point/2", "/nothing",
        "/time/nothing", "/radius", "time.end.x"})
    EXPECT_EQ(path(text), "none") << text;
  const auto innermost = [](const char* text) -> std::string {
    const Entry* e = find_innermost_entry(text);
    return e == nullptr ? "none" : e->path;
  };
  EXPECT_EQ(innermost("/walls/0/point/2"), "walls.<number>.point");
  EXPECT_EQ(innermost("/walls/-"), "walls");
  EXPECT_EQ(innermost("/output/of_another_version"), "output");
  EXPECT_EQ(innermost("/cell_types/a"), "cell_types");
  EXPECT_EQ(innermost("/nothing/end"), "none");
}

TEST(Registry, StartsMayDifferInLaterEffectsOnly) {
  Scene scene;
  scene.cell_types["born"] = {};
  scene.cell_types["aged"].cycle.random_start = true;
  const auto may = [&scene](const char* pointer) { return may_differ_at_start(scene, pointer); };
  for (const char* pointer :
       {"/name", "/experiment", "/model", "/time/step", "/output/every", "/friction/dcm_dcm",
        "/start_up/from", "/start_up/growth_time", "/vessels/contact", "/time/of_another_version",
        "/cell_types/born/cycle/time", "/cell_types/lost/cycle/time", "/cell_types/aged/death/mode",
        "/cell_types/aged/dcm/nodal_friction", "/cell_types/born/cbm/ecm_friction"})
    EXPECT_TRUE(may(pointer)) << pointer;
  for (const char* pointer :
       {"/seed", "/cells/model", "/contact/skin", "/start_up/enabled", "/vessels/file", "/nothing",
        "/cell_types/born", "/cell_types/born/cycle/start", "/cell_types/aged/cycle/time",
        "/cell_types/aged/cycle/of_another_version", "/cell_types/born/radius",
        "/cell_types/born/dcm/series_friction", "/start_up/of_another_version"})
    EXPECT_FALSE(may(pointer)) << pointer;
}

TEST(Registry, LawsHaveEveryConstantTheyDependOn) {
  const Scene scene = parse_scene(kMinimal, "scene.json");
  const LawParameters p = law_parameters(scene, scene.cell_types.at("hepatocyte"));
  for (const Entry& e : all_entries()) {
    const bool both = e.in_law == InLaw::kBoth;
    EXPECT_EQ(p.dcm.contains(e.law_name), both || e.in_law == InLaw::kDcm) << e.path;
    EXPECT_EQ(p.cbm.contains(e.law_name), both || e.in_law == InLaw::kCbm) << e.path;
  }
  EXPECT_EQ(p.dcm.at("nodes"), 162);
  EXPECT_EQ(p.dcm.at("contact_repulsion_kPa_per_um"), scene.contact.repulsion);
  EXPECT_EQ(p.cbm.at("young_kPa"), cbm::Params{}.young) << "that for which auto stands";
}

TEST(KeyValues, AreTakenAndPutByProperty) {
  const auto in_law = [](const Key& key) { return key.in_law != InLaw::kNo; };
  ContactBlock from, to;
  from.quadrature = contact::Quadrature::kNodesAndEdges;
  from.range_factor = 0.7;
  from.repulsion = 3;
  from.skin = 1;
  const std::vector<KeyValue> values =
      take_values([&from](Visitor& v) { describe_contact(v, from); }, in_law);
  const std::vector<KeyValue> wanted{std::string("nodes-and-edges"), 3.0, std::optional(0.7),
                                     from.max_depth};
  EXPECT_TRUE(values == wanted);
  put_values(
      values, [&to](Visitor& v) { describe_contact(v, to); }, in_law);
  EXPECT_EQ(to.quadrature, from.quadrature);
  EXPECT_EQ(to.range_factor, 0.7);
  EXPECT_EQ(to.repulsion, 3);
  EXPECT_EQ(to.skin, ContactBlock{}.skin) << "not chosen";
}

TEST(SceneDifferences, YoungerKeysWithTheirDefaultAreNoneInListsEither) {
  const std::string then = R"({"walls": [{"name": "a"}], "seed": 1})";
  const auto differences = [&then](const std::string& wall) {
    return list_scene_differences(then, R"({"walls": [{"name": "a")" + wall + R"(}], "seed": 1})",
                                  [](const std::string&) { return false; });
  };
  EXPECT_TRUE(differences(R"(, "adhesion": "0 J/m^2")").empty());
  EXPECT_TRUE(differences(R"(, "speed": "0 um/h", "opens": "auto")").empty());
  EXPECT_EQ(differences(R"(, "speed": "1 um/h")").size(), 1u);
  EXPECT_EQ(differences(R"(, "of_another_version": true)").size(), 1u);
}

TEST(Explain, ABlockListsItsKeysWithDefaultAndMeaning) {
  const std::string friction = explain_key("friction"), walls = explain_key("walls");
  EXPECT_CONTAINS(friction, "\n  keys\n    dcm_dcm      \"5e10 N s/m^3\"  friction between two");
  EXPECT_CONTAINS(friction, ", per contact area\n    cbm_cbm      \"auto\"          friction");
  EXPECT_CONTAINS(walls, "    normal    [0, 0, 1]                 direction to the side");
  EXPECT_CONTAINS(walls, "    mirror    (required)                true: a symmetry plane");
  EXPECT_CONTAINS(walls, "Poisson ratio of the wall (only with mirror = false)\n");
  EXPECT_CONTAINS(explain_key("cell_types"),
                  "\n    cycle          (block)           growth to twice");
  EXPECT_CONTAINS(explain_key("cell.dcm"), "\n    nodes                  162 ");
  EXPECT_EQ(explain_key("wall.mirror").find("keys"), std::string::npos) << "no block";
}

}  // namespace
}  // namespace acinus::runs
