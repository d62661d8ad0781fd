#include <gtest/gtest.h>

#include "runs/experiments/read_scene.hpp"
#include "tests/paths.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

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
  EXPECT_EQ(scene.walls.size(), 3u);
}

TEST(SceneExtends, ErrorsNameTheFileTheyStandIn) {
  TemporaryFolder folder;
  const std::string base = folder.write("base/base.json", minimal("\"2 h\"", "\"2 kPa\""));
  const std::string top =
      folder.write("top.json", "{\"extends\": \"base/base.json\",\n\"seed\": 1.5}");
  const std::string message = file_failure(top);
  EXPECT_EQ(message.find(top + ":2:9 /seed = 1.5"), 0u) << message;
  EXPECT_CONTAINS(message, "\n" + base + ":2:19 /time/end = \"2 kPa\"");
}

TEST(SceneExtends, CirclesAndMissingFilesAreRefused) {
  TemporaryFolder folder;
  const std::string a = folder.write("a.json", R"({"extends": "b.json"})");
  const std::string b = folder.write("b.json", R"({"extends": "./a.json"})");
  EXPECT_EQ(file_failure(a), b + ":1:13 /extends = \"./a.json\": the files extend each other in a "
                                 "circle");
  const std::string self = folder.write("self.json", R"({"extends": "self.json"})");
  EXPECT_CONTAINS(file_failure(self), "circle");
  const auto extending = [&](const char* text) {
    return file_failure(folder.write("n.json", text));
  };
  EXPECT_CONTAINS(extending(R"({"extends": "clump13"})"), "acinus new clump13 ");
  EXPECT_CONTAINS(extending(R"({"extends": "no.json"})"), ":1:13 /extends = \"no.json\": no such ");
  EXPECT_CONTAINS(extending(R"({"extends": 3})"), "must be the path");
}

}  // namespace
}  // namespace acinus::runs
