/// Rules between the law of contact and what else a scene has.

#include <gtest/gtest.h>

#include "dcm/contact/contact_params.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

TEST(SceneContactLaw, ItsKeysAreRead) {
  const Scene scene = parse_scene(
      with_block(R"("contact": {"law": "maugis-dugdale", "h0": "50 nm", "modulus": "30 kPa", )"
                 R"("max_radius": "200 um"})"),
      "scene.json");
  EXPECT_EQ(scene.contact.cohesive_range, 0.05);
  EXPECT_EQ(scene.contact.modulus, 30);
  EXPECT_EQ(scene.contact.max_radius, 200);
  EXPECT_EQ(parse_scene(kMinimal, "scene.json").contact.law, dcm::ContactLaw::kCohesive);
}

TEST(SceneContactErrors, MaugisDugdaleActsBetweenTriangles) {
  const auto law = [](const std::string& more) {
    return with_block(R"("contact": {"law": "maugis-dugdale"})" + more);
  };
  const std::string start = R"(scene.json:1:22 /contact/law = "maugis-dugdale": )";
  EXPECT_EQ(failure(law("")), "");
  EXPECT_EQ(failure(law(R"(, "walls": [{"mirror": true}])")), "");
  EXPECT_EQ(failure(law(""), {"model=cbm"}), "");
  EXPECT_EQ(failure(law(""), {"contact.quadrature=nodes"}),
            start + "acts between triangles. Set /contact/quadrature to \"3-point\"");
  EXPECT_EQ(failure(law(""), {"friction.form=nodes"}), "");
  EXPECT_EQ(failure(with_block(R"("contact": {"h0": "20 nm"})")),
            R"(scene.json:1:21 /contact/h0 = "20 nm": is used only with law = maugis-dugdale. )"
            "Remove it");
}

TEST(SceneVesselErrors, FlexibleVesselsNeedWhatTheyGoWith) {
  const std::string lobule = R"("lobule": {}, "vessels": {"flexible": true})";
  const std::string start = "/vessels/flexible = true: ";
  EXPECT_CONTAINS(failure(with_block(R"("vessels": {"flexible": true})")),
                  start + "needs vessels: give /vessels/file or a lobule block");
  EXPECT_CONTAINS(failure(with_block(lobule), {"life.sleep=true"}),
                  start + "goes only where all cells are awake: set /life/sleep to false");
  EXPECT_CONTAINS(failure(with_block(lobule), {"vessels.contact=mesh"}),
                  start +
                      "goes with cones only, which follow the vessels: set "
                      "/vessels/contact to \"cones\"");
  EXPECT_CONTAINS(failure(with_block(R"("lobule": {}, "vessels": {"spacing": "5 um"})")),
                  "/vessels/spacing = \"5 um\": is used only with flexible = true");
}

}  // namespace
}  // namespace acinus::runs
