/// Scenes of imported label images.

#include <gtest/gtest.h>

#include "core/sphere.hpp"
#include "geometry/measures.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/images/write_tissue.hpp"
#include "tests/imaging/labelled_balls.hpp"

namespace acinus::runs {
namespace {

using geometry::TempFolder;
using imaging::balls, imaging::options_for;

TEST(WriteTissue, MakesASceneThatStartsWithTheVolumesOfTheImage) {
  const TempFolder folder;
  const imaging::ImportOptions o = options_for(folder, balls(imaging::kTwoBalls));
  const std::string out = folder.path() + "/tissue";
  const imaging::ImportedTissue t = imaging::import_image(o);
  const std::vector<std::string> written = write_tissue(t, o, {}, out);
  EXPECT_CONTAINS(test::message_of([&] { write_tissue(t, o, {}, out); }), "exists already");
  const Scene scene = read_scene(written.front());
  EXPECT_EQ(scene.name, "tissue");
  const BuiltWorld built = build_world(scene, Ranks::serial());
  const dcm::State& s = built.world.state.dcm;
  int seen = 0;
  for (std::size_t lane = 0; lane < s.n_lane(); ++lane) {
    if (!s.active(lane)) continue;
    ++seen;
    const imaging::ImportedCell& c = t.cell[static_cast<std::size_t>(s.lineage[lane])];
    std::vector<Vec3> node;
    dcm::copy_nodes(s, lane, node);
    const auto& triangle = s.group[lane / kLanes].topology->triangle;
    EXPECT_NEAR(geometry::compute_volume(node, triangle), c.volume, 1e-6 * c.volume);
    EXPECT_NEAR(s.volume[lane].at(0), c.volume, 1e-6 * c.volume);
    EXPECT_LT((geometry::compute_centroid(node, triangle) - c.center).norm(), 0.3);
  }
  EXPECT_EQ(seen, 2);
  // The same as spheres.
  const BuiltWorld spheres =
      build_world(read_scene(written.front(), {"model=cbm"}), Ranks::serial());
  ASSERT_EQ(spheres.world.state.cbm.n_cell(), 2u);
  EXPECT_NEAR(sphere_volume(8), spheres.world.state.cbm.volume[0].at(0), 0.15 * sphere_volume(8));
}

TEST(WriteTissue, PutsMirrorWallsWhereTheBorderCutsCells) {
  const TempFolder folder;
  imaging::ImportOptions o =
      options_for(folder, balls({{1, {0, 20, 20}, 9}, {2, {60, 20, 20}, 9}}));
  o.keep_border = true;
  const std::vector<std::string> written =
      write_tissue(imaging::import_image(o), o, {}, folder.path() + "/tissue");
  const Scene scene = read_scene(written.front());
  ASSERT_EQ(scene.walls.size(), 2u);
  EXPECT_EQ(scene.walls[0].normal, Vec3(1, 0, 0));
  EXPECT_EQ(scene.walls[1].point, Vec3(60, 0, 0));
  EXPECT_TRUE(scene.walls[1].mirror);
}

}  // namespace
}  // namespace acinus::runs
