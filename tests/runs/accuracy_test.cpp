/// Named accuracies: the keys they set, and explicit keys that win.

#include "runs/scene/accuracy.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

Scene read_minimal(const std::vector<std::string>& set) {
  return parse_scene(kMinimal, "scene.json", ".", set);
}

void expect_settings(const Scene& scene, const AccuracySettings& a) {
  EXPECT_EQ(scene.cell_types.at("hepatocyte").dcm.nodes, a.nodes);
  EXPECT_EQ(scene.contact.quadrature, a.quadrature);
  EXPECT_EQ(scene.contact.range_factor, a.range);
  EXPECT_EQ(scene.contact.skin, a.skin);
  EXPECT_EQ(scene.numerics.max_step, a.step);
  EXPECT_EQ(scene.numerics.tolerance, a.tolerance);
  EXPECT_EQ(scene.numerics.max_move, a.max_move);
  EXPECT_EQ(scene.numerics.cg.tolerance, a.solver);
}

TEST(Accuracy, SetsAllItsKeys) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kFine})
    expect_settings(read_minimal({"accuracy=" + name_of_choice(accuracy)}), settings_of(accuracy));
}

TEST(Accuracy, GetsFinerByName) {
  const AccuracySettings &fast = settings_of(Accuracy::kFast),
                         &balanced = settings_of(Accuracy::kBalanced),
                         &fine = settings_of(Accuracy::kFine);
  EXPECT_LT(fast.nodes, balanced.nodes);
  EXPECT_LT(balanced.nodes, fine.nodes);
  EXPECT_GT(fast.step, balanced.step);
  EXPECT_GT(balanced.step, fine.step);
  EXPECT_GT(fast.tolerance, balanced.tolerance);
  EXPECT_GT(balanced.tolerance, fine.tolerance);
}

TEST(Accuracy, ByKeyLeavesTheDefaults) {
  EXPECT_EQ(read_minimal({"accuracy=by-key"}).hash, read_minimal({}).hash);
  EXPECT_EQ(read_minimal({}).numerics.max_step, coupling::Numerics{}.max_step);
}

TEST(Accuracy, ExplicitKeysWin) {
  const Scene scene =
      read_minimal({"accuracy=fine", "time.step=7 s", "cell_types.hepatocyte.dcm.nodes=92",
                    "contact.quadrature=3-point"});
  EXPECT_EQ(scene.numerics.max_step, 7);
  EXPECT_EQ(scene.cell_types.at("hepatocyte").dcm.nodes, 92);
  EXPECT_EQ(scene.contact.quadrature, contact::Quadrature::kThreePoint);
  EXPECT_EQ(scene.contact.range_factor, 0) << "the range of nodes and edges with other points";
  EXPECT_EQ(scene.numerics.tolerance, settings_of(Accuracy::kFine).tolerance);
  EXPECT_EQ(read_minimal({"accuracy=fast", "contact.range=0.3"}).contact.range_factor, 0.3);
}

TEST(Accuracy, LeavesThePointsOfThePapersLaw) {
  const Scene scene = read_minimal({"accuracy=fast", "contact.law=maugis-dugdale"});
  EXPECT_EQ(scene.contact.quadrature, contact::Quadrature::kThreePoint);
  EXPECT_EQ(scene.contact.range_factor, 0);
  EXPECT_EQ(scene.numerics.max_step, settings_of(Accuracy::kFast).step);
}

TEST(Accuracy, ResolvedSceneIsTheSameScene) {
  const Scene scene = read_scene(find_scene_file("spheroid"));
  EXPECT_EQ(scene.accuracy, Accuracy::kFast);
  const Scene again = parse_scene(scene.resolved_json, "again.json");
  EXPECT_EQ(again.hash, scene.hash);
  expect_settings(read_minimal({"accuracy=fast"}), settings_of(Accuracy::kFast));
}

TEST(Accuracy, RejectsOtherNames) {
  try {
    read_minimal({"accuracy=coarse"});
    FAIL() << "an unknown accuracy was accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("balanced"), std::string::npos) << e.what();
  }
}

TEST(Accuracy, DescribesSettingsAndErrors) {
  const std::string text = describe_accuracy(read_minimal({"accuracy=balanced"}));
  EXPECT_NE(text.find("362 nodes"), std::string::npos) << text;
  EXPECT_NE(text.find("contact area"), std::string::npos) << text;
  EXPECT_EQ(text.find("other values"), std::string::npos) << text;
  const std::string mixed =
      describe_accuracy(read_minimal({"accuracy=balanced", "time.step=60 s"}));
  EXPECT_NE(mixed.find("other values of /time/step,"), std::string::npos) << mixed;
}

}  // namespace
}  // namespace acinus::runs
