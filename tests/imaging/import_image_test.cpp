/// Import of label images: cells that are kept, labels left out and their reasons, refused images.

#include <gtest/gtest.h>

#include "core/sphere.hpp"
#include "geometry/measures.hpp"
#include "imaging/import_image.hpp"
#include "tests/imaging/labelled_balls.hpp"

namespace acinus::imaging {
namespace {

using geometry::TempFolder;

std::string why(const ImportedTissue& t, Label label, std::size_t n_voxel = 0) {
  for (const LeftOut& l : t.left_out)
    if (l.label == label && (n_voxel == 0 || l.n_voxel == n_voxel)) return l.why;
  return "";
}

TEST(ImportImage, KeepsCellsAndSaysWhatItLeavesOut) {
  const TempFolder folder;
  auto all = kTwoBalls;
  all.push_back({4, {50, 30, 30}, 2.6});  // a speck
  all.push_back({5, {45, 8, 30}, 0.9});   // one voxel
  all.push_back({6, {58, 10, 10}, 6});    // cut off by the border
  all.push_back({3, {45, 8, 8}, 1.8});    // a second piece of label 3
  const ImportedTissue t = import_image(options_for(folder, balls(all)));
  ASSERT_EQ(t.cell.size(), 2u);
  EXPECT_EQ(t.cell[0].label, 3u);
  EXPECT_EQ(t.cell[1].label, 9u);
  EXPECT_EQ(t.touching, (std::vector<std::array<Label, 2>>{{3, 9}}));
  EXPECT_EQ(t.cell[0].neighbours, 1);
  for (const ImportedCell& c : t.cell)
    EXPECT_NEAR(geometry::compute_volume(c.surface.node, c.surface.triangle), c.volume,
                1e-9 * c.volume);
  EXPECT_CONTAINS(why(t, 4), "a speck");
  EXPECT_CONTAINS(why(t, 5), "fewer than 27 voxels");
  EXPECT_CONTAINS(why(t, 6), "cut off by the border");
  EXPECT_CONTAINS(why(t, 3), "does not hang together");
  EXPECT_TRUE(t.vessel.empty());
}

TEST(ImportImage, TakesVesselsFromALabelOrAnotherImage) {
  const TempFolder folder;
  const auto tube = [](const Vec3& x) { return std::hypot(x[0] - 45, x[1] - 20) < 5; };
  LabelImage image = balls({{3, {15, 20, 20}, 8}, {9, {33, 20, 20}, 8}});
  LabelImage vessels = image;
  for (int z = 0; z < 40; ++z)
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        const std::size_t at = image.index({x, y, z});
        vessels.label[at] = tube(image.center({x, y, z})) ? 1 : 0;
        if (vessels.label[at] != 0) image.label[at] = 77;
      }
  ImportOptions o = options_for(folder, image);
  o.vessel_label = 77;
  const ImportedTissue named = import_image(o);
  o.vessel_label = 0;
  o.vessels = folder.path() + "/vessels.mha";
  write_image(o.vessels, vessels);
  const ImportedTissue other = import_image(o);
  for (const ImportedTissue& t : {named, other}) {
    ASSERT_EQ(t.vessel.size(), 1u);
    ASSERT_EQ(t.cell.size(), 2u);
    EXPECT_FALSE(t.cell[0].at_vessel);
    EXPECT_TRUE(t.cell[1].at_vessel);
    const double volume = geometry::compute_volume(t.vessel[0].node, t.vessel[0].triangle);
    EXPECT_NEAR(volume, kPi * 25 * 40, 0.03 * kPi * 25 * 40);
  }
  ASSERT_EQ(other.warnings.size(), 1u);
  EXPECT_CONTAINS(other.warnings[0], "voxels belong to a cell and to a vessel");
  o.vessels.clear();
  o.vessel_label = 5;
  EXPECT_CONTAINS(test::message_of([&] { import_image(o); }), "no voxel is labelled 5");
}

TEST(ImportImage, KeepsCellsAtTheBorderIfAsked) {
  const TempFolder folder;
  ImportOptions o = options_for(folder, balls({{1, {0, 20, 20}, 9}, {2, {60, 20, 20}, 9}}));
  const std::string message = test::message_of([&] { import_image(o); });
  EXPECT_CONTAINS(message, "none of its 2 labels can be kept");
  EXPECT_CONTAINS(message, "--border keep");
  o.keep_border = true;
  EXPECT_EQ(import_image(o).cell.size(), 2u);
}

TEST(ImportImage, TellsLabelsThatWereUsedTwice) {
  const TempFolder folder;
  std::vector<LabelledBall> all;
  for (int k = 0; k < 6; ++k)
    all.push_back(
        {static_cast<Label>(k % 3 + 1), Vec3(10 + 20 * (k / 2), k % 2 == 0 ? 10 : 30, 20), 6});
  ImportOptions o = options_for(folder, balls(all));
  const std::string message = test::message_of([&] { import_image(o); });
  EXPECT_CONTAINS(message, "3 of 3 labels are in several large pieces, label 1 first");
  EXPECT_CONTAINS(message, "its type counts to 255 only");
  EXPECT_CONTAINS(message, "--split");
  o.split = true;
  const ImportedTissue t = import_image(o);
  EXPECT_EQ(t.cell.size(), 6u);
  for (std::size_t k = 0; k < t.cell.size(); ++k)
    EXPECT_NEAR(t.cell[k].volume, sphere_volume(6), 0.03 * sphere_volume(6));
}

TEST(ImportImage, RefusesImagesWithoutCells) {
  const TempFolder folder;
  EXPECT_CONTAINS(test::message_of([&] { import_image(options_for(folder, balls({}))); }),
                  "all voxels are 0, the background");
}

/// Two balls with 1 added to every label: 1 is outside.
LabelImage raised(const std::vector<LabelledBall>& all) {
  LabelImage image = balls(all);
  for (Label& l : image.label) ++l;
  return image;
}

TEST(ImportImage, AsksAboutALabelThatEnclosesTheImage) {
  const TempFolder folder;
  ImportOptions o = options_for(folder, raised(kTwoBalls));
  const std::string message = test::message_of([&] { import_image(o); });
  EXPECT_CONTAINS(message, "label 1 fills 96 % of the image");
  EXPECT_CONTAINS(message, "--background 1");
  o.background = 1;
  const ImportedTissue t = import_image(o);
  ASSERT_EQ(t.cell.size(), 2u);
  EXPECT_EQ(t.cell[0].label, 4u);
  EXPECT_NEAR(t.cell[0].volume, sphere_volume(8), 0.03 * sphere_volume(8));
  o.background = 7;
  EXPECT_CONTAINS(test::message_of([&] { import_image(o); }),
                  "--background 7: no voxel has this label");
  o.background = 0;  // it is a cell, cut off by the border
  EXPECT_CONTAINS(why(import_image(o), 1), "cut off by the border");
}

TEST(ImportImage, DoesNotTakeTheUsualVolumeFromOneGiant) {
  const TempFolder folder;
  // A lumen of 28 cells' volume that no border cuts, with a label of its own.
  std::vector<LabelledBall> all{{1, {40, 20, 20}, 15}, {2, {10, 10, 20}, 5}, {3, {10, 30, 20}, 5}};
  const ImportedTissue t = import_image(options_for(folder, balls(all)));
  EXPECT_EQ(t.cell.size(), 3u);
  all[0].radius = 19;
  all.push_back({4, {10, 20, 10}, 3.5});
  all.push_back({5, {10, 20, 30}, 3.5});
  const ImportedTissue warnings = import_image(options_for(folder, balls(all)));
  ASSERT_EQ(warnings.warnings.size(), 1u);
  EXPECT_CONTAINS(warnings.warnings[0], "--background 1");
}

TEST(ImportImage, NeverTakesATightCropForABackground) {
  const TempFolder folder;
  const LabelImage one = make_image({16, 16, 16}, Vec3::Ones(), [](const Vec3& x) {
    return (x - Vec3(8, 8, 8)).norm() < 8 ? Label{1} : Label{0};
  });
  ImportOptions o = options_for(folder, one);
  o.keep_border = true;
  EXPECT_EQ(import_image(o).cell.size(), 1u);
}

TEST(ImportImage, ReadsVesselsWithTheChoicesOfTheCells) {
  const TempFolder folder;
  ImportOptions o = options_for(folder, balls(kTwoBalls));
  o.read.unit = 2;
  o.vessels = folder.path() + "/vessels.tif";
  write_image(o.vessels, balls({{1, {30, 36, 20}, 3}}));
  const ImportedTissue t = import_image(o);
  EXPECT_NEAR(t.voxel[0], 2, 1e-12);
  EXPECT_EQ(t.vessel.size(), 1u);
  ASSERT_EQ(t.warnings.size(), 2u);
  EXPECT_CONTAINS(t.warnings[0], "the file says units of 1 um; 2 um is taken, as --unit says");
  EXPECT_CONTAINS(t.warnings[1], "vessels.tif: the file says voxels of 1 x 1 x 1 um; 2 x 2 x 2 um");
}

TEST(ImportImage, SmoothsHolesAway) {
  const TempFolder folder;
  LabelImage image = balls(kTwoBalls);
  for (int x = 0; x < 60; ++x) image.label[image.index({x, 20, 20})] = 0;  // a needle through both
  const ImportedTissue t = import_image(options_for(folder, image));
  EXPECT_EQ(t.cell.size(), 2u);
}

}  // namespace
}  // namespace acinus::imaging
