/// Meshes that degenerate are found and mended; all others are left alone.

#include "coupling/life/mesh_health.hpp"
#include "coupling/life/life.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/parallel/clock.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/measure/audit.hpp"
#include "coupling/measure/measure.hpp"
#include "dcm/shape/mesh_remedy.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/worlds.hpp"
#include "tests/reference/cell_shapes.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::coupling {
namespace {

constexpr double kCellRadius = 12;

enum class Damage { kNone, kNoise, kEdge, kNeedle, kFold };

struct Case {
  const char* shape;
  Damage damage;
  double noise;  ///< in mean edges
  const char* name;
};

/// Moves the directions of a mesh: node 20 goes nearly onto a neighbour, onto the opposite side of
/// a triangle, or past a neighbour; or all nodes go anywhere.
void spoil(const geometry::Topology& t, Damage damage, double noise, std::vector<Vec3>& d) {
  constexpr std::size_t kNode = 20;
  UniformStream random = reference::stream(7);
  const Vec3 here = d[kNode];
  const Vec3 next = d[t.ring[t.ring_start[kNode]]];
  if (damage == Damage::kEdge) d[kNode] = 0.02 * here + 0.98 * next;
  if (damage == Damage::kFold) d[kNode] = here + 1.6 * (next - here);
  if (damage == Damage::kNeedle) {
    const int face = t.node_triangle[t.node_triangle_start[kNode]];
    Vec3 side = Vec3::Zero();
    for (const int i : t.triangle[face])
      if (i != static_cast<int>(kNode)) side += (side.isZero() ? 0.6 : 0.4) * d[i];
    d[kNode] = 0.01 * here + 0.99 * side;
  }
  if (damage == Damage::kNoise)
    for (Vec3& x : d) x += 0.5 * noise * t.mean_rest_length * reference::normal_vector(random);
  for (Vec3& x : d) x.normalize();
}

std::vector<Vec3> make_spoiled(const geometry::Topology& t, const Case& c) {
  const auto shapes = reference::cell_shapes();
  const auto shape = std::ranges::find(shapes, std::string(c.shape), &reference::CellShape::name);
  UniformStream random = reference::stream(8);
  const Mat3 turn = reference::random_rotation(random);
  std::vector<Vec3> node;
  for (const Vec3& x : t.rest) node.push_back((turn * x).normalized());
  spoil(t, c.damage, c.noise, node);
  for (Vec3& x : node) x = shape->place(x);
  const double scale =
      kCellRadius * std::cbrt(4 * kPi / 3 / geometry::compute_volume(node, t.triangle));
  for (Vec3& x : node) x = Vec3(30, -20, 10) + scale * x;
  return node;
}

/// Checks and repairs meshes after a step that crossed the time grid.
LifeReport look(World& world, Workspace& work) {
  LifeReport report;
  world.state.clock.time = 600;
  world.state.clock.last_step = 60;
  mend_meshes(world, work, report);
  return report;
}

void set_nodes(World& world, std::size_t lane, const std::vector<Vec3>& node) {
  for (std::size_t i = 0; i < node.size(); ++i)
    store_point(world.state.dcm.position.data(),
                dcm::node_address(world.state.dcm, lane, static_cast<int>(i)), node[i]);
}

double deepest_overlap(const World& world) {
  const State& s = world.state;
  std::vector<std::vector<Vec3>> node(s.dcm.n_lane());
  std::vector<AuditMesh> mesh;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    if (!s.dcm.active(l)) continue;
    dcm::copy_nodes(s.dcm, l, node[l]);
    mesh.push_back({s.dcm.lineage[l], node[l], s.dcm.group[l / kLanes].topology->triangle});
  }
  AuditFrame frame;
  frame.meshes = mesh;
  return audit(frame).dcm_dcm.depth_um;
}

TEST(MeshHealth, OrdinaryShapesAreNotSuspicious) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  for (const auto& shape : reference::cell_shapes()) {
    const dcm::MeshHealth h = dcm::measure_health(
        t, make_spoiled(t, {shape.name.c_str(), Damage::kNone, 0, ""}), kCellRadius);
    std::printf("%-14s quality %.3f spacing %.3f fold %.2f\n", shape.name.c_str(), h.quality,
                h.spacing, h.opposed);
    EXPECT_FALSE(dcm::is_suspicious(h)) << shape.name;
  }
}

class Mending : public ::testing::TestWithParam<Case> {};

TEST_P(Mending, GivesASoundMeshOnTheSameSurface) {
  const Case c = GetParam();
  const geometry::Topology& t = geometry::shared_icosphere(162);
  const std::vector<Vec3> node = make_spoiled(t, c);
  const double volume = geometry::compute_volume(node, t.triangle);
  ASSERT_TRUE(dcm::is_suspicious(dcm::measure_health(t, node, kCellRadius)));
  const dcm::Mended m = dcm::mend_mesh(t, node, kCellRadius);
  ASSERT_TRUE(m.ok) << m.why;
  const dcm::SurfaceShift shift = dcm::compare_surfaces(t, node, m.node);
  const double kept = geometry::compute_volume(m.node, t.triangle) / volume - 1;
  std::printf(
      "%-26s %-8s quality %.3f -> %.3f, spacing %.2f -> %.2f, fold %.2f -> %.2f; %.2f um "
      "out, %.2f in, %.2f lost; area %+.1f %%, volume %.0e\n",
      c.name, m.method.c_str(), m.before.quality, m.after.quality, m.before.spacing,
      m.after.spacing, m.before.opposed, m.after.opposed, shift.outside, shift.inside, shift.lost,
      100 * m.area_change, kept);
  EXPECT_GE(m.after.quality, dcm::kGoodQuality);
  EXPECT_GE(m.after.spacing, dcm::kGoodSpacing);
  EXPECT_FALSE(geometry::AuditBody(m.node, t.triangle).self_intersects());
  // match_volume ends within 1e-12; the sum of 320 terms rounds by some 1e-15 more.
  EXPECT_LT(std::abs(kept), 1.01e-12);
  EXPECT_LE(shift.outside, 0.3);
  EXPECT_LE(shift.inside, 0.6);
  EXPECT_LE(shift.lost, 1);
  EXPECT_LE(std::abs(m.area_change), dcm::kMostAreaChange);
}

INSTANTIATE_TEST_SUITE_P(
    MeshHealth, Mending,
    ::testing::Values(Case{"sphere", Damage::kNoise, 0.5, "sphere_noise"},
                      Case{"sphere", Damage::kEdge, 0, "sphere_collapsed_edge"},
                      Case{"sphere", Damage::kNeedle, 0, "sphere_needle"},
                      Case{"sphere", Damage::kFold, 0, "sphere_fold"},
                      Case{"ellipsoid 2:1", Damage::kNoise, 0.5, "ellipsoid_noise"},
                      Case{"pancake 4:1", Damage::kEdge, 0, "pancake_collapsed_edge"},
                      Case{"pancake 4:1", Damage::kNeedle, 0, "pancake_needle"},
                      Case{"packed", Damage::kNeedle, 0, "packed_needle"},
                      Case{"packed", Damage::kEdge, 0, "packed_collapsed_edge"},
                      Case{"dented", Damage::kFold, 0, "dented_fold"},
                      Case{"crescent", Damage::kEdge, 0, "crescent_collapsed_edge"},
                      Case{"crescent", Damage::kFold, 0, "crescent_fold"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(MeshHealth, HealthyCellsAreLeftAloneToTheBit) {
  World world = make_test_world({{Vec3(0, 0, 0)}, {Vec3(23.5, 0, 0)}});
  SizedWorkspace work(world);
  ASSERT_TRUE(run_until(world, work, 600));
  world.state.clock.last_step = 60;
  const std::uint64_t before = hash_state(world.state);
  EXPECT_TRUE(look(world, work).events.empty());
  EXPECT_EQ(hash_state(world.state), before);
}

TEST(MeshHealth, HopelessCellIsNamedAndNotTouched) {
  World world = make_test_world({{Vec3(30, -20, 10)}});
  const geometry::Topology& t = geometry::shared_icosphere(162);
  set_nodes(world, 0, make_spoiled(t, {"horseshoe", Damage::kNoise, 0.5, ""}));
  SizedWorkspace work(world);
  world.state.clock.time = 600;
  world.state.clock.last_step = 60;
  const std::uint64_t before = hash_state(world.state);
  const LifeReport report = look(world, work);
  ASSERT_EQ(report.events.size(), 1u);
  std::printf("%s: %s\n", name_of(report.events[0].kind), report.events[0].message.c_str());
  EXPECT_EQ(report.events[0].kind, EventKind::kMeshDegenerate);
  EXPECT_EQ(report.events[0].cells, std::vector<std::int64_t>{0});
  EXPECT_EQ(hash_state(world.state), before);
  world.params.life.remesh = false;
  EXPECT_TRUE(look(world, work).events.empty());
}

TEST(MeshHealth, LooksOnlyWhenAStepCrossesTheTimeGrid) {
  World world = make_test_world({{Vec3(30, -20, 10)}});
  set_nodes(world, 0,
            make_spoiled(geometry::shared_icosphere(162), {"sphere", Damage::kEdge, 0, ""}));
  SizedWorkspace work(world);
  LifeReport report;
  world.state.clock.last_step = 60;
  for (const double time : {60.0, 599.9, 660.0, 1199.0}) {
    world.state.clock.time = time;
    mend_meshes(world, work, report);
    EXPECT_TRUE(report.events.empty()) << time;
  }
  world.state.clock.time = 1230;
  mend_meshes(world, work, report);
  ASSERT_EQ(report.events.size(), 1u);
  EXPECT_EQ(report.events[0].kind, EventKind::kRemeshed);
}

/// Thirteen cells pressed together; nothing is damaged.
World make_packed() {
  std::vector<TestCell> cells;
  for (const Vec3& x : make_clump({Lattice::kFcc, 13, 22.5, 0}, [] { return 0.5; }))
    cells.push_back({x});
  World world = make_test_world(cells);
  world.params.numerics.adaptive = true;
  world.params.numerics.max_move = 0.3;
  for (dcm::Params& p : world.params.dcm) p.diffusion = 0;
  SizedWorkspace work(world);
  EXPECT_TRUE(run_until(world, work, 3600));
  return world;
}

/// Puts one node of a cell nearly onto a neighbour, or past it, on the cell's surface; the volume
/// stays.
void spoil_in_place(World& world, std::size_t lane, int node, double share) {
  std::vector<Vec3> x;
  dcm::copy_nodes(world.state.dcm, lane, x);
  const geometry::Topology& t = geometry::shared_icosphere(162);
  const std::size_t i = node;
  const std::size_t j = t.ring[t.ring_start[i]];
  const std::vector<Vec3> before = x;
  x[i] = geometry::AuditBody(before, t.triangle).closest_point(x[i] + share * (x[j] - x[i]));
  const std::vector<double> all(x.size(), 1.0);
  ASSERT_TRUE(dcm::match_volume(t, geometry::compute_volume(before, t.triangle), all, x));
  set_nodes(world, lane, x);
}

/// Spoils the innermost cell and has it mended.   @return hash of the state a step later
std::uint64_t mend_in_clump(const World& packed, double share, const char* name) {
  World world = packed;
  SizedWorkspace work(world);
  observe(world, work);
  const std::vector<CellMeasure> sound = measure_cells(world, work);
  const double overlap_sound = deepest_overlap(world);
  std::size_t inner = 0;
  for (std::size_t l = 0; l < world.state.dcm.n_lane(); ++l)
    if (world.state.dcm.active(l) && dcm::cell_center(world.state.dcm, l).norm() <
                                         dcm::cell_center(world.state.dcm, inner).norm())
      inner = l;
  for (const int node : {20, 100}) spoil_in_place(world, inner, node, share);
  const std::int64_t mended = world.state.dcm.lineage[inner];
  const double overlap_spoiled = deepest_overlap(world);
  double overlap_put = 0;
  size_workspace(world, work);
  observe(world, work);
  const std::vector<CellMeasure> spoiled = measure_cells(world, work);
  {  // as it stands before it settles with its neighbours
    World still = world;
    std::vector<Vec3> node;
    dcm::copy_nodes(still.state.dcm, inner, node);
    set_nodes(still, inner,
              dcm::mend_mesh(geometry::shared_icosphere(162), node, kCellRadius).node);
    overlap_put = deepest_overlap(still);
  }
  const LifeReport report = look(world, work);
  EXPECT_EQ(report.events.size(), 1u);
  EXPECT_EQ(report.events[0].kind, EventKind::kRemeshed) << report.events[0].message;
  EXPECT_EQ(report.events[0].cells, std::vector<std::int64_t>{mended});
  const double overlap_mended = deepest_overlap(world);
  observe(world, work);
  const std::vector<CellMeasure> after = measure_cells(world, work);
  const StepResult step = take_step(world, work, 60);
  observe(world, work);
  const std::vector<CellMeasure> next = measure_cells(world, work);
  double moved = 0, pressure = 0, contact = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    if (after[k].id != mended) moved = std::max(moved, (next[k].center - spoiled[k].center).norm());
    pressure =
        std::max(pressure, 1e3 * std::abs(after[k].cytosol_pressure - spoiled[k].cytosol_pressure));
    contact = std::max(contact, 1e3 * std::abs(next[k].pressure - sound[k].pressure));
  }
  std::printf(
      "%s: %s\n  overlap %.3f um sound, %.3f spoiled, %.3f mended, %.3f settled, %.3f a step "
      "later; "
      "neighbours moved %.3f um; cytosol pressure changed by %.2f Pa, contact pressure by "
      "%.2f Pa; step %.3g s, %d rejections\n",
      name, report.events[0].message.c_str(), overlap_sound, overlap_spoiled, overlap_put,
      overlap_mended, deepest_overlap(world), moved, pressure, contact, step.step, step.rejections);
  EXPECT_LT(overlap_put, 0.3);
  EXPECT_LT(overlap_mended, 0.3);
  EXPECT_TRUE(step.accepted);
  EXPECT_LT(moved, 0.1);
  EXPECT_LT(pressure, 5);
  EXPECT_LT(contact, 20);
  EXPECT_TRUE(find_suspicious(world.state).empty());
  const std::uint64_t hash = hash_state(world.state);
  // Beyond the hour in which the cortex forgets the new mesh.
  for (const double end = world.state.clock.time + 2 * 3600; world.state.clock.time < end;) {
    EXPECT_TRUE(take_step(world, work, 600).accepted);
    EXPECT_TRUE(live(world, work).events.empty());
  }
  EXPECT_LT(deepest_overlap(world), 0.3);
  return hash;
}

TEST(MeshHealth, CellsInAPackedClumpAreMendedInPlaceForAnyNumberOfThreads) {
  const World packed = make_packed();
  for (const auto& [share, name] : {std::pair{0.97, "collapsed edges"}, std::pair{1.6, "folds"}}) {
    set_threads(1);
    const std::uint64_t one = mend_in_clump(packed, share, name);
    set_threads(2);
    const std::uint64_t two = mend_in_clump(packed, share, name);
    EXPECT_EQ(one, two) << name;
  }
  set_threads(1);
}

/// Daughters settle by up to the length of an edge, and a triangle that collapses folds the cell
/// within minutes: longer than the grid of life.
TEST(MeshHealth, CellsThatRememberTheirBirthAreMendedAfterEveryStep) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  const std::vector<Vec3> node = make_spoiled(t, {"sphere", Damage::kEdge, 0, ""});
  for (const bool young : {true, false}) {
    World world = make_test_world({{Vec3(30, -20, 10)}});
    world.params.life.grid = 600;
    SizedWorkspace work(world);
    set_nodes(world, 0, node);
    world.state.clock.phase = Phase::kRun;
    world.state.clock.time = 330;
    world.state.clock.last_step = 20;  // no grid point within it
    if (young)
      world.state.dcm.birth[0] =
          dcm::make_birth_shape(t, node, kCellRadius, 1, {1, 0, 0, dcm::kForgetShape});
    LifeReport report;
    mend_meshes(world, work, report);
    EXPECT_EQ(report.events.size(), young ? 1u : 0u);
    EXPECT_EQ(find_suspicious(world.state).empty(), young);
    EXPECT_TRUE(find_suspicious(world.state, true).empty()) << "no young cell is left so";
  }
}

/// One cell grows to eight; whatever growth and division do to meshes is no reason to mend them.
TEST(MeshHealth, GrowingClumpIsNeverTouched) {
  World world = make_test_world({{Vec3(0, 0, 0)}});
  world.params.numerics.adaptive = true;
  world.params.numerics.max_move = 0.3;
  CycleParams cycle;
  cycle.time = 6 * 3600;
  world.params.life.type = {cycle};
  world.state.next_lineage = 1;
  begin_life(world);
  SizedWorkspace work(world);
  const double start = cpu_seconds();
  dcm::MeshHealth worst;
  while (dcm::count_cells(world.state.dcm) < 8 || world.state.clock.time < 19.5 * 3600) {
    ASSERT_TRUE(take_step(world, work, 600).accepted);
    for (const LifeEvent& e : live(world, work).events) {
      EXPECT_NE(e.kind, EventKind::kRemeshed) << e.message;
      EXPECT_NE(e.kind, EventKind::kMeshDegenerate) << e.message;
    }
    std::vector<Vec3> node;
    for (std::size_t l = 0; l < world.state.dcm.n_lane(); ++l) {
      if (!world.state.dcm.active(l)) continue;
      dcm::copy_nodes(world.state.dcm, l, node);
      const double v = world.state.dcm.volume[l].at(world.state.clock.time);
      const dcm::MeshHealth h = dcm::measure_health(geometry::shared_icosphere(162), node,
                                                    std::cbrt(v / (4.0 / 3 * kPi)));
      worst.quality = std::min(worst.quality, h.quality);
      worst.spacing = std::min(worst.spacing, h.spacing);
      worst.opposed = std::min(worst.opposed, h.opposed);
    }
  }
  const double watch = work.timings.stage("mesh health").cpu;
  const double all = cpu_seconds() - start;
  std::printf(
      "%d cells, %ld steps: worst quality %.3f, spacing %.3f, fold %.2f; watch %.3f %% of "
      "the time\n",
      dcm::count_cells(world.state.dcm), static_cast<long>(world.state.clock.accepted),
      worst.quality, worst.spacing, worst.opposed, 100 * watch / all);
  EXPECT_GT(worst.quality, 3 * dcm::kPoorQuality);
  EXPECT_GT(worst.spacing, 3 * dcm::kPoorSpacing);
  EXPECT_GT(worst.opposed, dcm::kFolded);
  EXPECT_LT(watch, 0.02 * all);
}

}  // namespace
}  // namespace acinus::coupling
