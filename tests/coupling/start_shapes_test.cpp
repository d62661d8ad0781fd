#include "coupling/start_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "coupling/measure/audit.hpp"
#include "coupling/subworld/population.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

double volume_share(const World& w, std::size_t lane) {
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, lane, node);
  return geometry::compute_volume(node, w.state.dcm.group[lane / kLanes].topology->triangle) /
         w.state.dcm.volume[lane].at(0);
}

AuditResult audit_shells(const World& w) {
  const dcm::State& s = w.state.dcm;
  std::vector<std::vector<Vec3>> node(s.n_lane());
  std::vector<AuditMesh> meshes;
  for (std::size_t l = 0; l < s.n_lane(); ++l) {
    if (!s.active(l)) continue;
    dcm::copy_nodes(s, l, node[l]);
    meshes.push_back({s.lineage[l], node[l], s.group[l / kLanes].topology->triangle});
  }
  AuditFrame frame;
  frame.meshes = meshes;
  return audit(frame);
}

/// Cells at the corners of a cube, some of them spheres.
std::vector<TestCell> make_cube(double distance, int n_sphere) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 8; ++k)
    cells.push_back({distance * Vec3(k & 1, (k >> 1) & 1, k >> 2), k >= n_sphere, Vec3::Zero(),
                     11.0 + 0.25 * k});
  return cells;
}

TEST(StartShapes, CellsThatContactCanMendKeepTheirShape) {
  World w = make_test_world(make_cube(24, 0));
  const HeldRows<double> before = w.state.dcm.position;
  EXPECT_TRUE(cut_overlapping(w).cells.empty());
  EXPECT_EQ(w.state.dcm.position, before);
}

TEST(StartShapes, CellsDeepInEachOtherAreCutApart) {
  World w = make_test_world(make_cube(15, 0));
  const CutCells cut = cut_overlapping(w);
  EXPECT_EQ(cut.cells, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  const AuditResult audit = audit_shells(w);
  EXPECT_LT(audit.dcm_dcm.depth_um, 1e-9);
  EXPECT_EQ(audit.n_self_intersecting, 0);
  EXPECT_EQ(audit.n_inverted, 0);
  double smallest = 1;
  for (std::size_t l = 0; l < 8; ++l) smallest = std::min(smallest, volume_share(w, l));
  EXPECT_NEAR(cut.smallest_volume, smallest, 1e-12);
  // A corner has lost three of its six sides at 7.5 of 12 um.
  EXPECT_GT(smallest, 0.5);
  EXPECT_LT(smallest, 0.8);
}

TEST(StartShapes, TheCortexIsAtRestAndForgets) {
  World w = make_test_world(make_cube(15, 0));
  cut_overlapping(w);
  const dcm::BirthShape& b = w.state.dcm.birth[0];
  EXPECT_EQ(b.weight.at(0), 1);
  EXPECT_EQ(b.weight.at(dcm::kForgetShape), 0);
  // Nothing but pressure and contact acts: what opens the clump is the volume that is missing.
  w.params.dcm[0].adhesion = 0;
  SizedWorkspace work(w);
  const double before = volume_share(w, 0);
  while (w.state.clock.time < 600) ASSERT_TRUE(take_step(w, work, 600).accepted);
  EXPECT_GT(volume_share(w, 0), before);
  EXPECT_LT(audit_shells(w).dcm_dcm.depth_um, w.params.dcm_contact.max_depth);
}

TEST(StartShapes, SpheresStayAndTheirNeighboursAreCutAtTheSharedPlane) {
  World w = make_test_world(make_cube(15, 4));
  const HeldRows<double> before = w.state.cbm.position;
  const CutCells cut = cut_overlapping(w);
  EXPECT_EQ(cut.cells, (std::vector<std::int64_t>{4, 5, 6, 7}));
  EXPECT_EQ(w.state.cbm.position, before);
  for (std::size_t l = 0; l < 4; ++l) EXPECT_LT(volume_share(w, l), 0.85);
}

TEST(StartShapes, DoNotDependOnTheOrderOfCells) {
  auto cells = make_cube(16, 3);
  World a = make_test_world(cells);
  const CutCells cut = cut_overlapping(a);
  World b = make_test_world(cells);
  std::vector<SelectedCell<State>> dcm = list_dcm(b.state), cbm = list_cbm(b.state);
  std::ranges::reverse(dcm);
  std::ranges::reverse(cbm);
  b.state = compose(dcm, cbm, b.state);
  EXPECT_EQ(cut_overlapping(b).cells, cut.cells);
  for (std::size_t l = 0; l < a.state.dcm.n_lane(); ++l) {
    if (!a.state.dcm.active(l)) continue;
    const auto other =
        static_cast<std::size_t>(std::ranges::find(b.state.dcm.lineage, a.state.dcm.lineage[l]) -
                                 b.state.dcm.lineage.begin());
    EXPECT_NEAR(volume_share(a, l), volume_share(b, other), 1e-9);
  }
}

}  // namespace
}  // namespace acinus::coupling
