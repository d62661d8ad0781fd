#include "coupling/measure/audit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"
#include "tests/reference/brick.hpp"

namespace acinus::coupling {
namespace {

using geometry::Surface;
using reference::brick;

Surface ball(const Vec3& center, double radius, int n_node = 162) {
  const geometry::Topology& topology = geometry::shared_icosphere(n_node);
  Surface out;
  out.triangle = topology.triangle;
  for (const Vec3& x : topology.rest) out.node.push_back(center + radius * x);
  return out;
}

/// Audits bodies numbered 100, 101, ... with the other members of `frame` as they are.
AuditResult audit_bodies(const std::vector<Surface>& bodies, AuditFrame frame = {}) {
  std::vector<AuditMesh> mesh;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    mesh.push_back({100 + static_cast<std::int64_t>(i), bodies[i].node, bodies[i].triangle});
  frame.meshes = mesh;
  return audit(frame);
}

using Ids = std::vector<std::int64_t>;

/// Depth of the samples of `a` in a convex body `b`: there the distance to the surface is the
/// smallest distance to a face plane.
double convex_depth(const Surface& a, const Surface& b) {
  std::vector<Vec3> sample = a.node;
  for (const auto& t : a.triangle) {
    const Vec3 &x = a.node[t[0]], &y = a.node[t[1]], &z = a.node[t[2]];
    sample.insert(sample.end(), {(x + y) / 2, (y + z) / 2, (z + x) / 2, (x + y + z) / 3});
  }
  double depth = 0;
  for (const Vec3& p : sample) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : b.triangle) {
      const Vec3& x = b.node[t[0]];
      const Vec3 n = (b.node[t[1]] - x).cross(b.node[t[2]] - x).normalized();
      nearest = std::min(nearest, (x - p).dot(n));
    }
    depth = std::max(depth, nearest);
  }
  return depth;
}

TEST(Audit, OverlappingBricksHaveTheirExactDepth) {
  // The edges of the small brick lie 0.25 deep; its face diagonal's middle and corners likewise.
  const auto r = audit_bodies({brick({0, 0, 0}, {10, 10, 10}), brick({9.75, 2, 2}, {12, 8, 8})});
  EXPECT_DOUBLE_EQ(r.dcm_dcm.depth_um, 0.25);
  EXPECT_EQ(r.dcm_dcm.ids, (Ids{100, 101}));
  EXPECT_DOUBLE_EQ(r.max_penetration_um, 0.25);
  EXPECT_EQ(r.n_inverted, 0);
  EXPECT_EQ(r.n_self_intersecting, 0);
}

// More queries than are answered at a time: bodies are dropped, and needed again only in part.
TEST(Audit, ARowOfManyBricksHasTheDepthOfEveryPair) {
  constexpr int kBricks = 599;  // a prime: 7 k mod n meets every place
  std::vector<Surface> bodies;
  for (int k = 0; k < kBricks; ++k) {  // numbered across the row
    const double at = 9.75 * (7 * k % kBricks), deeper = k % 2 == 0 ? 1e-4 * k : 0;
    bodies.push_back(brick({at - deeper, 0, 0}, {at + 10, 10, 10}));
  }
  const auto r = audit_bodies(bodies);  // 598 is deepest; at the place before it is 170
  EXPECT_NEAR(r.dcm_dcm.depth_um, 0.25 + 1e-4 * 598, 1e-9);
  EXPECT_EQ(r.dcm_dcm.ids, (Ids{100 + 170, 100 + 598}));
  EXPECT_EQ(r.n_self_intersecting, 0);
  EXPECT_EQ(r.n_inverted, 0);
}

TEST(Audit, OverlappingCellsHaveTheDepthOfTheirGeometry) {
  for (const double distance : {23.9, 23.5, 23.0, 20.0, 14.0}) {
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0.6, 0.8, 0), Vec3(0.36, 0.48, 0.8)}) {
      const Surface a = ball(Vec3::Zero(), 12), b = ball(distance * way, 12);
      const double expected = std::max(convex_depth(a, b), convex_depth(b, a));
      const auto r = audit_bodies({a, b});
      EXPECT_NEAR(r.dcm_dcm.depth_um, expected, 1e-12 * 12)
          << distance;  // round-off of coordinates
      EXPECT_NEAR(r.dcm_dcm.depth_um, 24 - distance,
                  0.4);  // facets differ from the sphere by 0.2 um
    }
  }
}

TEST(Audit, TouchingBodiesDoNotOverlap) {
  const Surface a = brick({0, 0, 0}, {4, 4, 4});
  for (const Vec3& low :
       {Vec3(4, 0, 0), Vec3(4, 1, 1), Vec3(4, 4, 0), Vec3(4, 4, 4), Vec3(4, 2, -2)}) {
    const auto r = audit_bodies({a, brick(low, low + Vec3(4, 4, 4))});
    EXPECT_EQ(r.dcm_dcm.depth_um, 0) << low.transpose();
    EXPECT_TRUE(r.dcm_dcm.ids.empty());
  }
}

TEST(Audit, TunnelledCellsAreSeen) {
  const Surface large = ball(Vec3::Zero(), 12);
  const auto concentric = audit_bodies({large, ball(Vec3::Zero(), 3)});
  EXPECT_NEAR(concentric.dcm_dcm.depth_um, 9, 0.5);
  const auto deep = audit_bodies({large, ball({14, 0, 0}, 12)});
  EXPECT_NEAR(deep.dcm_dcm.depth_um, 10, 0.5);
  // Coinciding cells have every sample on the other's surface: only the centroid shows the overlap.
  const Surface coarse = ball(Vec3::Zero(), 12, 42);
  const auto same = audit_bodies({coarse, coarse});
  EXPECT_NEAR(same.dcm_dcm.depth_um, 12, 1);
  EXPECT_GT(audit_bodies({large, ball({0.3, 0, 0}, 12)}).dcm_dcm.depth_um, 11);
  std::printf("concentric %.3f, 10 um in %.3f, coinciding %.3f\n", concentric.dcm_dcm.depth_um,
              deep.dcm_dcm.depth_um, same.dcm_dcm.depth_um);
}

TEST(Audit, ASpikePushedThroughIsSeen) {
  // One node of the left cell is pulled through the right cell and out at its far side.
  Surface left = ball({-12.5, 0, 0}, 12);
  const Surface right = ball({12.5, 0, 0}, 12);
  ASSERT_EQ(audit_bodies({left, right}).dcm_dcm.depth_um, 0);
  const auto tip = std::max_element(left.node.begin(), left.node.end(),
                                    [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  *tip = {30, 0, 0};
  const auto r = audit_bodies({left, right});
  std::printf("spike depth %.3f\n", r.dcm_dcm.depth_um);
  EXPECT_GT(r.dcm_dcm.depth_um, 9);  // the spike is a few um wide and passes by the centre, 12 deep
  EXPECT_LT(r.dcm_dcm.depth_um, 12);
}

TEST(Audit, CrossedBarsWithoutASampleInsideCount) {
  // The long diagonal of a side passes x = 0 at z = 3/7, so 3/7 + 1/2 above the other bar's bottom.
  const auto r =
      audit_bodies({brick({-8, -1, -1}, {20, 1, 1}), brick({-1, -8, -0.5}, {1, 20, 1.5})});
  EXPECT_NEAR(r.dcm_dcm.depth_um, 13.0 / 14, 1e-14);
}

double brute_cone_depth(const Vec3& x, const Vec3& a, const Vec3& b, double ra, double rb) {
  double depth = -1e300;
  for (int i = 0; i <= 20000; ++i) {
    const double t = i / 20000.0;
    depth = std::max(depth, ra + t * (rb - ra) - (x - a - t * (b - a)).norm());
  }
  return depth;
}

TEST(Audit, CellAgainstTaperedVesselIsTheDepthInTheRoundCone) {
  const Surface cell = ball({0, 0, 14.5}, 12);
  for (const auto& [ra, rb] : {std::array{3.0, 3.0}, {5.0, 2.0}, {1.0, 6.0}, {40.0, 2.0}}) {
    const geometry::Network net{{Vec3(-20, 3, 0), Vec3(18, -2, 1)}, {{0, 1}}, {{ra, rb}}};
    double expected = 0;
    for (const Vec3& x : cell.node)
      expected = std::max(expected, brute_cone_depth(x, net.node[0], net.node[1], ra, rb));
    AuditFrame frame;
    frame.vessels = &net;
    const auto r = audit_bodies({cell}, frame);
    // Edges and faces may lie deeper than the nodes, by at most the sagitta of an edge of 4 um on
    // the wall.
    EXPECT_GE(r.dcm_vessel.depth_um, expected - 1e-4);
    EXPECT_LE(r.dcm_vessel.depth_um, expected + 0.7);
    EXPECT_EQ(r.dcm_vessel.ids, (Ids{100, 0}));
  }
}

TEST(Audit, FlatFaceOnAVesselHasItsExactDepth) {
  const geometry::Network net{{Vec3(-50, 0, 0), Vec3(50, 0, 0)}, {{0, 1}}, {{4.7, 4.7}}};
  AuditFrame frame;
  frame.vessels = &net;
  EXPECT_NEAR(audit_bodies({brick({-5, -9, 4.5}, {6, 8, 14})}, frame).dcm_vessel.depth_um, 0.2,
              1e-12);
  EXPECT_EQ(audit_bodies({brick({-5, -9, 4.75}, {6, 8, 14})}, frame).dcm_vessel.depth_um, 0);
}

TEST(Audit, ThinVesselsBetweenTheSamplesAreSeen) {
  const Surface cell = brick({-10, -10, -10}, {10, 10, 10});
  AuditFrame frame;
  const geometry::Network ending{{Vec3(3, 5.5, 10.2), Vec3(3, 5.5, 40)}, {{0, 1}}, {{0.3, 0.3}}};
  frame.vessels = &ending;
  EXPECT_NEAR(audit_bodies({cell}, frame).dcm_vessel.depth_um, 0.1, 1e-12);
  const geometry::Network through{
      {Vec3(0.5, 0.5, -40), Vec3(0.5, 0.5, 40)}, {{0, 1}}, {{0.3, 0.3}}};
  frame.vessels = &through;  // axis 9.5 um inside the nearest side
  EXPECT_NEAR(audit_bodies({cell}, frame).dcm_vessel.depth_um, 9.8, 1e-12);
  const geometry::Network within{{Vec3(-1, 0, 0), Vec3(1, 0, 0)}, {{0, 1}}, {{0.3, 0.3}}};
  frame.vessels = &within;
  EXPECT_NEAR(audit_bodies({cell}, frame).dcm_vessel.depth_um, 9.3, 1e-12);
}

TEST(Audit, PlanesAndCapsulesCountTheFarthestNode) {
  const Surface cell = brick({0, 0, -0.5}, {4, 4, 6});
  AuditFrame frame;
  std::vector<AuditWall> walls{AuditPlane{{9, 0, 0}, {-1, 0, 0}}, AuditPlane{}};
  frame.walls = walls;
  auto r = audit_bodies({cell}, frame);
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, 0.5);
  EXPECT_EQ(r.dcm_wall.ids, (Ids{100, 1}));
  walls.push_back(AuditCapsule{{2, 2, 2.75}, 3});
  frame.walls = walls;
  r = audit_bodies({cell}, frame);
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, std::sqrt(4 + 4 + 3.25 * 3.25) - 3);
  EXPECT_EQ(r.dcm_wall.ids, (Ids{100, 2}));
}

TEST(Audit, PipettesCountTheFarthestNode) {
  // A tube along x from x = 1 on: inner radius 2, outer 5, rims rounded with 1.
  const AuditPipette tube{{1, 0, 0}, {1, 0, 0}, 3, 4, 1, 19, 1};
  EXPECT_DOUBLE_EQ(depth_behind(tube, {10, 0, 0}, 0), -2);
  EXPECT_DOUBLE_EQ(depth_behind(tube, {10, 0, 1}, 1.5), 0.5);
  EXPECT_DOUBLE_EQ(depth_behind(tube, {10, 3.5, 0}, 0), 1.5);
  EXPECT_DOUBLE_EQ(depth_behind(tube, {2 - 3, 0, 4 + 4}, 0), -4);
  EXPECT_DOUBLE_EQ(depth_behind(tube, {0.5, 3.5, 0}, 2), 1.5);
  AuditFrame frame;
  const std::vector<AuditWall> walls{tube};
  frame.walls = walls;
  const auto r = audit_bodies({brick({5, -1, -1}, {9, 1, 2.25})}, frame);
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, std::hypot(1, 2.25) - 2);
}

std::vector<AuditStaticMesh> block_and_box(const Surface& block, const Surface& box) {
  std::vector<AuditStaticMesh> static_meshes;
  static_meshes.push_back({prepare_static_mesh(block.node, block.triangle, "block"), false});
  static_meshes.push_back({prepare_static_mesh(box.node, box.triangle, "box"), true});
  return static_meshes;
}

TEST(Audit, StaticMeshesFromOutsideAndInside) {
  const Surface block = brick({0, 0, 0}, {50, 50, 10}), box = brick({-9, -9, -9}, {60, 60, 60});
  AuditFrame frame;
  const std::vector<AuditStaticMesh> static_meshes = block_and_box(block, box);
  frame.static_meshes = static_meshes;
  EXPECT_EQ(audit_bodies({brick({5, 5, 10}, {9, 9, 14})}, frame).dcm_wall.depth_um, 0);
  auto r = audit_bodies({brick({5, 5, 9.5}, {9, 9, 14})}, frame);
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, 0.5);
  EXPECT_EQ(r.dcm_wall.ids, (Ids{100, 0}));
  r = audit_bodies({brick({55, 20, 20}, {61, 30, 30})}, frame);
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, 1);
  EXPECT_EQ(r.dcm_wall.ids, (Ids{100, 1}));
  r = audit_bodies({brick({80, 20, 20}, {85, 30, 30})}, frame);  // left the box altogether
  EXPECT_DOUBLE_EQ(r.dcm_wall.depth_um, 25);
  Surface open = block;
  open.triangle.pop_back();
  EXPECT_THROW(prepare_static_mesh(open.node, open.triangle, "an open mesh"), Error);
}

TEST(Audit, SpheresAgainstCellsAndEachOther) {
  const Surface cell = brick({0, 0, 0}, {20, 20, 20});
  AuditFrame frame;
  std::vector<AuditSphere> spheres{
      {7, {10.3, 9.1, 31.5}, 12}, {8, {60, 0, 0}, 5}, {9, {66, 0, 0}, 2}};
  frame.spheres = spheres;
  auto r = audit_bodies({cell}, frame);
  EXPECT_NEAR(r.dcm_cbm.depth_um, 0.5, 1e-13);
  EXPECT_EQ(r.dcm_cbm.ids, (Ids{100, 7}));
  EXPECT_DOUBLE_EQ(r.max_overlap_cbm_um, 1);
  EXPECT_EQ(r.cbm_cbm.ids, (Ids{8, 9}));
  EXPECT_NEAR(r.max_penetration_um, 0.5, 1e-13);  // spheres among themselves do not count here
  spheres = {{7, {10, 10, 12}, 3}};               // swallowed, 8 um below the top
  frame.spheres = spheres;
  EXPECT_DOUBLE_EQ(audit_bodies({cell}, frame).dcm_cbm.depth_um, 11);
  spheres = {{7, {10, 10, 32}, 12}};
  frame.spheres = spheres;
  EXPECT_EQ(audit_bodies({cell}, frame).dcm_cbm.depth_um, 0);
}

TEST(Audit, SpheresInVesselsAndWallsAreToldAndAreNoPenetration) {
  geometry::Network net;
  net.node = {{0, 0, 0}, {0, 0, 40}, {0, 0, 80}};
  net.segment = {{0, 1}, {1, 2}};
  net.radius = {{4.7, 4.7}, {4.7, 4.7}};
  AuditFrame frame;
  frame.vessels = &net;
  std::vector<AuditSphere> spheres{{7, {15.7, 0, 20}, 12}, {8, {0, 15.2, 60}, 12}};
  frame.spheres = spheres;
  auto r = audit(frame);
  EXPECT_NEAR(r.cbm_vessel.depth_um, 1.5, 1e-13);
  EXPECT_EQ(r.cbm_vessel.ids, (Ids{8, 1}));
  EXPECT_EQ(r.max_penetration_um, 0);
  // 2 um of the lower sphere lie behind the plane, 5.1 um of the upper one: |(15.2, 20)| + 12 - 33
  const AuditWall walls[] = {AuditPlane{{0, 0, 10}, {0, 0, 1}}, AuditCapsule{{0, 0, 40}, 33}};
  frame.walls = walls;
  r = audit(frame);
  EXPECT_NEAR(r.cbm_wall.depth_um, std::hypot(15.7, 20) + 12 - 33, 1e-13);
  EXPECT_EQ(r.cbm_wall.ids, (Ids{7, 1}));
  frame.walls = std::span(walls).first(1);
  r = audit(frame);
  EXPECT_NEAR(r.cbm_wall.depth_um, 2, 1e-13);
  EXPECT_EQ(r.cbm_wall.ids, (Ids{7, 0}));
  const Surface block = brick({25, -20, 0}, {60, 20, 40}), box = brick({-9, -30, 0}, {60, 30, 90});
  const std::vector<AuditStaticMesh> static_meshes = block_and_box(block, box);
  frame.walls = {};
  frame.static_meshes = static_meshes;
  r = audit(frame);  // one reaches 12 - (25 - 15.7) into the block, the other 12 - 9 out of the box
  EXPECT_NEAR(r.cbm_wall.depth_um, 3, 1e-13);
  EXPECT_EQ(r.cbm_wall.ids, (Ids{8, 1}));
  EXPECT_TRUE(r.center_in_static.ids.empty()) << "both centres are where they may be";
}

TEST(Audit, CentresOnTheWrongSideOfStaticMeshesAreTold) {
  const Surface block = brick({0, 0, 0}, {50, 50, 50}), box = brick({-9, -9, -9}, {90, 90, 90});
  const std::vector<AuditStaticMesh> static_meshes = block_and_box(block, box);
  AuditFrame frame;
  frame.static_meshes = static_meshes;
  // The large one reaches deeper into the block, but the small one's centre is in it.
  std::vector<AuditSphere> spheres{{7, {25, 25, 51}, 12}, {8, {25, 25, 47}, 5}};
  frame.spheres = spheres;
  auto r = audit(frame);
  EXPECT_NEAR(r.center_in_static.depth_um, 3, 1e-13);
  EXPECT_EQ(r.center_in_static.ids, (Ids{8, 0}));
  spheres = {{7, {70, 70, 120}, 12}};  // far from any triangle, outside the box
  frame.spheres = spheres;
  r = audit(frame);
  EXPECT_NEAR(r.center_in_static.depth_um, 30, 1e-13);
  EXPECT_EQ(r.center_in_static.ids, (Ids{7, 1}));
}

/// Radius 10: sisters are born 5.2 um apart, and 4.1 um are what is left of it in radii when they
/// have grown to twice their volume without moving.
TEST(Audit, SistersMayBeInEachOtherUntilTheyHaveComeApart) {
  AuditFrame frame;
  const auto overlap = [&](double distance, double strength, std::int64_t other_mother) {
    const std::vector<AuditSphere> spheres{{7, {0, 0, 0}, 10, strength, 3},
                                           {8, {distance, 0, 0}, 10, strength, other_mother}};
    frame.spheres = spheres;
    return audit_bodies({}, frame).cbm_cbm.depth_um;
  };
  EXPECT_EQ(overlap(5, 0.5, 3), 0) << "coming apart";
  EXPECT_EQ(overlap(1, 0.5, 3), 0) << "compressed while weak";
  EXPECT_EQ(overlap(5, 1, 3), 0) << "not apart yet";
  EXPECT_DOUBLE_EQ(overlap(4, 1, 3), 16) << "nearer than at birth";
  EXPECT_DOUBLE_EQ(overlap(11, 1, 3), 9) << "an overlap like any other";
  EXPECT_DOUBLE_EQ(overlap(5, 0.5, 4), 15) << "newborn, but not sisters";
  EXPECT_DOUBLE_EQ(overlap(5, 0.5, -1), 15);
}

TEST(Audit, BrokenCellsAreCounted) {
  Surface inverted = ball({100, 0, 0}, 12);
  for (auto& t : inverted.triangle) std::swap(t[0], t[1]);
  Surface crossing = ball({0, 0, 0}, 12);
  crossing.node[0] *= -1.5;  // pulled through the opposite side
  Surface folded = ball({0, 100, 0}, 12);
  {  // a node moved just past its opposite edge: only triangles with common corners cross
    const auto& t = folded.triangle[0];
    const Vec3 middle = (folded.node[t[1]] + folded.node[t[2]]) / 2;
    folded.node[t[0]] += 1.6 * (middle - folded.node[t[0]]);
  }
  Surface flat = brick({300, 0, 0}, {304, 4, 4});
  flat.node[7] = flat.node[3];  // an edge of length zero: two triangles without area
  const Surface sound = ball({0, 0, 200}, 12);
  auto r = audit_bodies({sound, inverted, crossing});
  EXPECT_EQ(r.n_inverted, 1);
  EXPECT_EQ(r.n_self_intersecting, 1);
  r = audit_bodies({sound, folded});
  EXPECT_EQ(r.n_self_intersecting, 1);
  r = audit_bodies({sound});
  EXPECT_EQ(r.n_self_intersecting, 0);
  EXPECT_GT(r.min_triangle_quality, 0.95);
  r = audit_bodies({sound, flat});
  EXPECT_EQ(r.min_triangle_quality, 0);
  EXPECT_EQ(r.worst_triangle_cell, 101);
  Surface lost = ball({0, 0, 0}, 12);
  lost.node[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(audit_bodies({lost}), Error);
}

TEST(Audit, EmptyFrameIsClean) {
  const auto r = audit({});
  EXPECT_EQ(r.max_penetration_um, 0);
  EXPECT_EQ(r.min_triangle_quality, 1);
}

TEST(Audit, HundredTouchingCellsGiveTheSameOnAnyThreadsAndPrintTheirTime) {
  std::vector<Surface> cells;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z)  // close packing, each pair pressed 0.2 um into the other
        cells.push_back(
            ball(23.8 * Vec3(x + 0.5 * ((y + z) % 2), std::sqrt(0.75) * (y + (z % 2) / 3.0),
                             std::sqrt(2.0 / 3) * z),
                 12));
  geometry::Network net;
  for (int s = 0; s < 150; ++s) {
    net.node.emplace_back(s % 10 * 10, s / 10 * 7, 0);
    net.node.emplace_back(s % 10 * 10 + 5, s / 10 * 7, 30);
    net.segment.push_back({2 * s, 2 * s + 1});
    net.radius.push_back({1, 2});
  }
  AuditFrame frame;
  frame.vessels = &net;
  AuditResult result[2];
  for (const int threads : {1, 2}) {
    const int before = thread_count();
    set_threads(threads);
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    result[threads - 1] = audit_bodies(cells, frame);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    set_threads(before);
    std::printf(
        "100 cells, 150 vessel segments, %d thread(s): %.3f s (CPU %.3f s), deepest %.3f um, in "
        "vessels %.3f "
        "um\n",
        threads, took.count(), static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
        result[threads - 1].dcm_dcm.depth_um, result[threads - 1].dcm_vessel.depth_um);
    RecordProperty("seconds_" + std::to_string(threads), std::to_string(took.count()));
  }
  EXPECT_EQ(result[0].dcm_dcm.depth_um, result[1].dcm_dcm.depth_um);
  EXPECT_EQ(result[0].dcm_dcm.ids, result[1].dcm_dcm.ids);
  EXPECT_EQ(result[0].dcm_vessel.ids, result[1].dcm_vessel.ids);
  EXPECT_GT(result[0].dcm_dcm.depth_um, 0);
}

TEST(Audit, IndentationExplainedByTheForceIsNotAPenetrationButTunnellingIs) {
  const geometry::Topology t = geometry::make_icosphere(162);
  auto audit_at = [&](double distance, double indentation) {
    std::vector<Vec3> node;
    for (const Vec3& x : t.rest) node.push_back(12 * x);
    const std::vector<AuditMesh> meshes{{1, node, t.triangle}};
    const std::vector<AuditSphere> spheres{{2, Vec3(distance, 0, 0), 12}};
    const std::vector<KnownIndentation> indentations{{1, 2, indentation}};
    AuditFrame frame;
    frame.meshes = meshes;
    frame.spheres = spheres;
    frame.indentations = indentations;
    return audit(frame);
  };
  const AuditResult pressed = audit_at(23.5, 0.4);
  EXPECT_GT(pressed.dcm_cbm.depth_um, 0.4);
  EXPECT_NEAR(pressed.dcm_cbm_beyond_indentation.depth_um, pressed.dcm_cbm.depth_um - 0.4, 1e-12);
  EXPECT_EQ(pressed.max_penetration_um, pressed.dcm_cbm_beyond_indentation.depth_um);
  const AuditResult tunnelled = audit_at(2, 0.19);  // centres nearly together, hardly any force
  EXPECT_GT(tunnelled.max_penetration_um, 10);
}

TEST(Audit, OfPartsGivesTheWorstOfTheWhole) {
  std::vector<Surface> surface;
  std::vector<AuditMesh> mesh;
  for (int k = 0; k < 6; ++k) surface.push_back(ball({9.0 * k + 0.3 * (k % 3), 0, 0}, 5));
  for (std::size_t k = 0; k < surface.size(); ++k)
    mesh.push_back(
        {100 + static_cast<std::int64_t>(k), surface[k].node, surface[k].triangle, false, true, k});
  std::vector<AuditSphere> sphere;
  for (std::size_t k = 0; k < 8; ++k)
    sphere.push_back({200 + static_cast<std::int64_t>(k),
                      Vec3(5.0 * static_cast<double>(k) + 0.1 * static_cast<double>(k % 3), 7, 0),
                      3, 1, -1, true, mesh.size() + k});
  AuditFrame frame;
  frame.meshes = mesh;
  frame.spheres = sphere;
  const std::vector<AuditWall> wall{AuditPlane{Vec3(0, 0, -4), Vec3::UnitZ()}};
  frame.walls = wall;
  const AuditResult whole = audit(frame);
  AuditResult part[2];
  for (const int p : {0, 1}) {
    for (std::size_t k = 0; k < mesh.size(); ++k)
      mesh[k].own = k % 2 == static_cast<std::size_t>(p);
    for (std::size_t k = 0; k < sphere.size(); ++k) sphere[k].own = (k / 3 % 2 == 0) == (p == 0);
    part[p] = audit(frame);
  }
  const auto expect_worst = [&](WorstPair AuditResult::*pair) {
    const WorstPair &a = part[0].*pair, &b = part[1].*pair, &w = whole.*pair;
    EXPECT_GT(w.depth_um, 0);
    const bool first = a.depth_um != b.depth_um ? a.depth_um > b.depth_um : a.number < b.number;
    const WorstPair& worse = first ? a : b;
    EXPECT_EQ(worse.depth_um, w.depth_um);
    EXPECT_EQ(worse.ids, w.ids);
    EXPECT_EQ(worse.number, w.number);
  };
  expect_worst(&AuditResult::dcm_dcm);
  expect_worst(&AuditResult::dcm_cbm);
  expect_worst(&AuditResult::dcm_wall);
  expect_worst(&AuditResult::cbm_cbm);
  EXPECT_EQ(std::max(part[0].max_penetration_um, part[1].max_penetration_um),
            whole.max_penetration_um);
}

}  // namespace
}  // namespace acinus::coupling
