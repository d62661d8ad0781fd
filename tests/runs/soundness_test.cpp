/// Frames from which a run must not go on.

#include "runs/session/soundness.hpp"

#include <gtest/gtest.h>

#include "coupling/step/workspace_size.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/experiments/snapshot.hpp"
#include "runs/session/audit_world.hpp"
#include "tests/messages.hpp"
#include "tests/reference/brick.hpp"

namespace acinus::runs {
namespace {

/// Excess of one sphere of 12 um at the origin beside a closed mesh.
Excess find_at(geometry::Surface surface, bool inside) {
  const Scene scene = parse_scene(R"({
  "time": {"end": "1 h"}, "motility": {"random": false},
  "cell_types": {"hepatocyte": {}},
  "cells": {"source": "list", "model": "cbm", "list": [{"position": ["0 um", "0 um", "0 um"]}]}
})",
                                  "scene.json");
  coupling::World world = build_world(scene, Ranks::serial()).world;
  world.params.boundary.meshes.push_back(
      contact::make_static_mesh("rock", std::move(surface), inside));
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  const Snapshot snapshot = take_snapshot(world, work);
  return find_excess(
      audit_world(world, work, snapshot, prepare_static_bodies(world.params.boundary)), world,
      work);
}

TEST(Soundness, ASphereMayLeanOnAStaticMesh) {
  EXPECT_EQ(find_at(reference::brick({-100, -100, -100}, {100, 100, -3}), false).depth_um, 0);
  EXPECT_EQ(find_at(reference::brick({-100, -100, -3}, {100, 100, 100}), true).depth_um, 0);
}

TEST(Soundness, ASphereInsideAStaticMeshIsLost) {
  const Excess near = find_at(reference::brick({-100, -100, -100}, {100, 100, 2}), false);
  EXPECT_NEAR(near.depth_um, 2, 1e-12);
  EXPECT_EQ(near.cause, "CBM cell 0 has its centre 2 um inside static mesh rock");
  EXPECT_EQ(near.cells, std::vector<std::int64_t>{0});
  const Excess deep = find_at(reference::brick({-100, -100, -100}, {100, 100, 100}), false);
  EXPECT_NEAR(deep.depth_um, 100, 1e-12) << "farther from any triangle than contact looks";
}

TEST(Soundness, ASphereOutsideTheMeshItLivesInIsLost) {
  const Excess out = find_at(reference::brick({-100, -100, 40}, {100, 100, 100}), true);
  EXPECT_NEAR(out.depth_um, 40, 1e-12);
  EXPECT_EQ(out.cause, "CBM cell 0 has its centre 40 um outside static mesh rock");
}

// A node 5 um outside of a cortex of 12 um, where half of contact.max_depth = 1.5 um is still safe.
TEST(Soundness, ANucleusOutsideItsCortexIsFound) {
  const Scene scene = parse_scene(R"({
  "time": {"end": "1 h"}, "motility": {"random": false},
  "cell_types": {"hepatocyte": {"dcm": {"nucleus": {}}}},
  "cells": {"source": "list", "model": "dcm", "list": [{"position": ["0 um", "0 um", "0 um"]}]}
})",
                                  "scene.json");
  coupling::World world = build_world(scene, Ranks::serial()).world;
  const auto find = [&world] {
    coupling::Workspace work;
    coupling::size_workspace(world, work);
    const Snapshot snapshot = take_snapshot(world, work);
    return find_excess(
        audit_world(world, work, snapshot, prepare_static_bodies(world.params.boundary)), world,
        work);
  };
  EXPECT_EQ(find().depth_um, 0);
  std::vector<Vec3> node;
  dcm::copy_nucleus(world.state.dcm, 0, node);
  node[11] = 17 * node[11].normalized();
  dcm::store_nucleus(node, 0, world.state.dcm);
  const Excess leak = find();
  // Faces of 162 nodes stand up to 4 % inside the sphere, nodes 2 % outside.
  EXPECT_NEAR(leak.depth_um, 5 - 0.75, 0.5);
  EXPECT_CONTAINS(leak.cause, "the nucleus of DCM cell 0 stands");
  EXPECT_EQ(leak.cells, std::vector<std::int64_t>{0});
}

}  // namespace
}  // namespace acinus::runs
