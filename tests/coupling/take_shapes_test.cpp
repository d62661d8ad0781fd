#include "coupling/take_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel/threads.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/worlds.hpp"
#include "tests/reference/cell_shapes.hpp"

namespace acinus::coupling {
namespace {

/// um, root mean square over the nodes of a lane.
double deviation(const World& w, std::size_t lane, const geometry::Surface& surface) {
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, lane, node);
  double square = 0;
  for (const Vec3& x : node)
    square += std::pow(geometry::compute_distance(x, surface.node, surface.triangle), 2);
  return std::sqrt(square / static_cast<double>(node.size()));
}

TEST(TakeShapes, CellsHaveVolumeAndSurfaceOfWhatTheyAreGiven) {
  const geometry::Topology& fine = geometry::shared_icosphere(2562);
  std::vector<geometry::Surface> surface;
  std::vector<TestCell> cells;
  for (const reference::CellShape& shape : reference::cell_shapes()) {
    const Vec3 place(100.0 * static_cast<double>(cells.size()), 0, 0);
    surface.push_back(reference::make_cell(shape, fine, 12, Mat3::Identity(), place));
    cells.push_back({geometry::compute_centroid(surface.back().node, surface.back().triangle)});
  }
  World w = make_test_world(cells);
  std::vector<CellSurface> given;
  for (std::size_t k = 0; k < surface.size(); ++k)
    given.push_back({static_cast<std::int64_t>(k), &surface[k]});
  const TakenShapes taken = take_shapes(given, w);
  for (const auto& [lineage, cause] : taken.round)
    ADD_FAILURE() << reference::cell_shapes()[static_cast<std::size_t>(lineage)].name << ": "
                  << cause;
  EXPECT_EQ(taken.laid + taken.inflated, static_cast<int>(surface.size()));
  EXPECT_GE(taken.inflated, 1) << "no point sees a horseshoe whole";
  EXPECT_GT(taken.worst_quality, 0.2);
  for (std::size_t lane = 0; lane < w.state.dcm.n_lane(); ++lane) {
    if (!w.state.dcm.active(lane)) continue;
    const auto k = static_cast<std::size_t>(w.state.dcm.lineage[lane]);
    const auto& triangle = w.state.dcm.group[lane / kLanes].topology->triangle;
    std::vector<Vec3> node;
    dcm::copy_nodes(w.state.dcm, lane, node);
    const double volume = geometry::compute_volume(surface[k].node, surface[k].triangle);
    EXPECT_NEAR(geometry::compute_volume(node, triangle), volume, 1e-9 * volume);
    EXPECT_FALSE(geometry::AuditBody(node, triangle).self_intersects());
    const std::string name = reference::cell_shapes()[k].name;
    EXPECT_LT(deviation(w, lane, surface[k]), name == "horseshoe" ? 0.6 : 0.4) << name;
    EXPECT_TRUE(!w.state.dcm.birth[lane].edge.empty()) << "at rest in the shape";
  }
}

TEST(TakeShapes, IsTheSameForAnyThreadsAndLeavesSpheresAlone) {
  const geometry::Topology& fine = geometry::shared_icosphere(642);
  const geometry::Surface shape =
      reference::make_cell(reference::cell_shapes()[1], fine, 12, Mat3::Identity(), Vec3::Zero());
  std::vector<HeldRows<double>> position;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    World w = make_test_world({{Vec3::Zero()}, {Vec3(40, 0, 0), false}});
    const HeldRows<double> spheres = w.state.cbm.position;
    const TakenShapes taken = take_shapes({{0, &shape}, {1, &shape}}, w);
    EXPECT_EQ(taken.laid, 1);
    EXPECT_EQ(w.state.cbm.position, spheres);
    position.push_back(w.state.dcm.position);
  }
  set_threads(1);
  EXPECT_EQ(position[0], position[1]);
}

}  // namespace
}  // namespace acinus::coupling
