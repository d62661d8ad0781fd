/// Cells with a nucleus in steps, in subworlds, in division and with a mended mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "core/parallel/threads.hpp"
#include "coupling/life/mesh_health.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/measure/nuclei.hpp"
#include "coupling/sleep/sleep.hpp"
#include "coupling/subworld/subworld.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

std::vector<Vec3> nucleus_of(const State& s, std::size_t lane) {
  std::vector<Vec3> node;
  dcm::copy_nucleus(s.dcm, lane, node);
  return node;
}
double nucleus_volume(const State& s, std::size_t lane) {
  return geometry::compute_volume(nucleus_of(s, lane),
                                  s.dcm.group[lane / kLanes].nucleus.topology->triangle);
}

/// Two cells that touch, with stiff nuclei of which the first stands off its middle.
World nucleated_pair(Integrator integrator = Integrator::kLinearlyImplicit) {
  World w = make_test_world({{Vec3::Zero()}, {Vec3(23, 0, 0)}}, 30, 42);
  w.params.numerics.integrator = integrator;
  w.params.dcm[0].nucleus = dcm::Nucleus{.size = 0.6, .link_young = 0.1};
  give_nuclei(w);
  std::vector<Vec3> node = nucleus_of(w.state, 0);
  for (Vec3& x : node) x.y() += 3.5;
  dcm::store_nucleus(node, 0, w.state.dcm);
  return w;
}

// Links pull it to the middle; what pulls at the nucleus pushes the cortex: nothing moves the whole
// but friction with the medium, which the pair's own forces cannot feel.
TEST(NucleusInACell, ReturnsToTheMiddle) {
  World w = nucleated_pair();
  SizedWorkspace work(w);
  const double before =
      geometry::compute_centroid(nucleus_of(w.state, 0), geometry::shared_icosphere(42).triangle)
          .y();
  ASSERT_TRUE(run_until(w, work, 3600));
  const double after =
      geometry::compute_centroid(nucleus_of(w.state, 0), geometry::shared_icosphere(42).triangle)
          .y() -
      dcm::cell_center(w.state.dcm, 0).y();
  std::printf("off the middle by %.2f um, then by %.2f um; momentum %.1e\n", before, after,
              w.state.balance.momentum);
  EXPECT_GT(before, 3);
  EXPECT_LT(std::abs(after), 0.1);
  // Of sums over 100 points: 1e2 kEps.
  EXPECT_LT(w.state.balance.momentum, 1e-12);
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
}

class Integrators : public testing::TestWithParam<Integrator> {};

TEST_P(Integrators, GoOnBitForBitFromASavedState) {
  World through = nucleated_pair(GetParam());
  if (GetParam() == Integrator::kExplicitEuler) through.params.numerics.max_step = 1e-3;
  const double step = through.params.numerics.max_step;
  SizedWorkspace work(through);
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(take_step(through, work, step).accepted);
  World resumed = through;
  SizedWorkspace fresh(resumed);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(take_step(through, work, step).accepted);
    ASSERT_TRUE(take_step(resumed, fresh, step).accepted);
  }
  EXPECT_EQ(hash_state(resumed.state), hash_state(through.state));
}

INSTANTIATE_TEST_SUITE_P(All, Integrators,
                         testing::Values(Integrator::kLinearlyImplicit, Integrator::kNewton,
                                         Integrator::kExplicitEuler));

// Implicit steps do not depend on their length where all comes to rest.
TEST(NucleusInACell, RestsAtTheSamePlaceForAllSteps) {
  double pressure[2] = {}, y[2] = {};
  for (const int k : {0, 1}) {
    World w = nucleated_pair();
    w.params.numerics.max_step = k == 0 ? 30 : 10;
    w.params.dcm[0].adhesion = 0;  // a pair that adheres goes on spreading for hours
    SizedWorkspace work(w);
    ASSERT_TRUE(run_until(w, work, 4 * 3600));
    pressure[k] = nucleus_volume(w.state, 0);
    y[k] = dcm::cell_center(w.state.dcm, 0).y();
  }
  std::printf("volume of the nucleus %.4f and %.4f um^3\n", pressure[0], pressure[1]);
  // Steps of 30 s and of 10 s differ by their errors while it moved, a few 1e-3 um of 3.5 um.
  EXPECT_NEAR(pressure[0] / pressure[1], 1, 1e-4);
  EXPECT_NEAR(y[0], y[1], 0.02);
}

TEST(NucleusInACell, IsNoContactOfTheCell) {
  World w = nucleated_pair();
  std::vector<Vec3> node = nucleus_of(w.state, 0);
  for (Vec3& x : node) x.y() += 1.5;  // against the cortex
  dcm::store_nucleus(node, 0, w.state.dcm);
  SizedWorkspace work(w);
  observe(w, work);
  EXPECT_TRUE(std::ranges::any_of(work.system.links.law, [&](const auto& law) {
    return work.contacts.kind_of(law.contact) == contact::ContactKind::kNucleus;
  }));
  const std::vector<CellMeasure> cells = measure_cells(w, work);
  const NodeMeasure nodes = measure_nodes(w, work);
  EXPECT_EQ(cells[0].contacts, 1);
  EXPECT_EQ(nodes.force.size(), 84u) << "only nodes of cortices";
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 42; ++i) sum += nodes.force[i];
  EXPECT_LT(std::abs(sum.y()), 0.3) << "that of the neighbour, which stands along x";
}

TEST(NucleusInACell, GoesThroughASubworld) {
  World w = nucleated_pair();
  w.state.cycle.assign(w.state.dcm.n_lane(), Cycle{});
  Subworld sub;
  extract_at_rest(w, {{0}, {}}, {{1}, {}}, sub);
  const std::vector<Vec3> before = nucleus_of(w.state, 0), neighbour = nucleus_of(w.state, 1);
  ASSERT_TRUE(relax(sub, 60).ok);
  write_moved(sub, w.state);
  EXPECT_LT((nucleus_of(w.state, 0)[5] - before[5]).y(), -0.01) << "its links pull";
  EXPECT_EQ(nucleus_of(w.state, 1), neighbour) << "constrained cells stand still, all of them";
}

TEST(NucleusInACell, KeepsItAwakeWhileItMoves) {
  World w = make_test_world({{Vec3::Zero()}}, 30, 42);
  w.params.dcm[0].nucleus = dcm::Nucleus{};
  give_nuclei(w);
  SizedWorkspace work(w);
  observe(w, work);
  EXPECT_LT(unbalanced_traction(w, work)[0], 1e-12);
  // One node off its place pulls at nodes of the nucleus only: there are no links.
  std::vector<Vec3> node = nucleus_of(w.state, 0);
  node[7] *= 1.1;
  dcm::store_nucleus(node, 0, w.state.dcm);
  observe(w, work);
  EXPECT_GT(unbalanced_traction(w, work)[0], 1e-2);
}

/// Grown to twice the volume, with nuclei of their size.
World dividing() {
  World w = make_living_world({{Vec3::Zero(), true, Vec3::Zero(), kMotherRadius}}, 162);
  w.params.dcm[0].nucleus = dcm::Nucleus{.link_young = 0.1};
  give_nuclei(w);
  begin_with_mothers(w);
  return w;
}

TEST(NucleusInACell, EachDaughterHasOne) {
  World w = dividing();
  const LifeReport report = look(w, 60);
  ASSERT_EQ(report.divisions.size(), 1u);
  EXPECT_EQ(count_events(report, EventKind::kSettlingFailed), 0);
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
  const double at_rest = 4.0 / 3 * kPi * 6 * 6 * 6;
  for (std::size_t lane : {0u, 1u}) {
    ASSERT_TRUE(w.state.dcm.active(lane));
    std::printf("nucleus of %.1f um^3 of %.1f at rest\n", nucleus_volume(w.state, lane), at_rest);
    // Bulk modulus 5 kPa against tensions of some 0.1 nN/um over 6 um: below 2 %.
    EXPECT_NEAR(nucleus_volume(w.state, lane) / at_rest, 1, 0.02);
    EXPECT_EQ(w.state.dcm.birth[lane].link.size(), 42u);
  }
  // On through mitosis, in which the links forget the shape of birth.
  SizedWorkspace work(w);
  const double end = w.state.clock.time + 5400;
  while (w.state.clock.time < end - 1e-6) {
    const StepResult r = take_step(w, work, end - w.state.clock.time);
    ASSERT_TRUE(r.accepted) << r.cause;
    live(w, work);
  }
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
}

TEST(NucleusInACell, GrowsWithIt) {
  World w = make_living_world({{Vec3::Zero()}}, 162);
  w.params.dcm[0].nucleus = dcm::Nucleus{};
  give_nuclei(w);
  begin_life(w);
  SizedWorkspace work(w);
  const double before = nucleus_volume(w.state, 0), cell = w.state.dcm.volume[0].at(0);
  const double end = 0.5 * kDay;
  while (w.state.clock.time < end - 1e-6)
    ASSERT_TRUE(take_step(w, work, end - w.state.clock.time).accepted);
  const double growth = w.state.dcm.volume[0].at(end) / cell;
  EXPECT_GT(growth, 1.3);
  // Growth goes on at 1e-5 per s; friction of its nodes holds it back by less than 1e-3.
  EXPECT_NEAR(nucleus_volume(w.state, 0) / before, growth, 2e-3 * growth);
}

// A node of the cortex pushed onto its neighbour: the cell gets a fresh mesh, and its nucleus turns
// with it.
TEST(NucleusInACell, SurvivesAFreshMesh) {
  World w = make_living_world({{Vec3::Zero()}}, 162);
  w.params.dcm[0].nucleus = dcm::Nucleus{.link_young = 0.1};
  give_nuclei(w);
  begin_life(w);
  const geometry::Topology& t = *w.state.dcm.group[0].topology;
  const int next = t.ring[t.ring_start[20]];
  const auto at = [&](int i) { return dcm::node_address(w.state.dcm, 0, i); };
  const Vec3 a = load_point(w.state.dcm.position.data(), at(20)),
             b = load_point(w.state.dcm.position.data(), at(next));
  store_point(w.state.dcm.position.data(), at(20), 0.02 * a + 0.98 * b);
  const double before = nucleus_volume(w.state, 0);
  SizedWorkspace work(w);
  w.params.life.remesh = true;
  w.state.clock.time = w.params.life.grid;
  w.state.clock.last_step = w.params.life.grid;
  LifeReport report;
  mend_meshes(w, work, report);
  ASSERT_EQ(count_events(report, EventKind::kRemeshed), 1);
  EXPECT_EQ(count_events(report, EventKind::kSettlingFailed), 0);
  EXPECT_EQ(w.state.dcm.birth[0].link.size(), 42u);
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
  // Chords of the turned mesh cut off at most 1 - (1 - 14 / 42 / 5)^(3/2) of it; bulk regains it.
  EXPECT_NEAR(nucleus_volume(w.state, 0) / before, 1, 0.05);
  ASSERT_TRUE(run_until(w, work, w.state.clock.time + 600));
}

// The pressure it stands under lets a cell shrink only to where its nucleus fits: it shrinks too.
TEST(NucleusInACell, ShrinksInLysis) {
  World w = make_living_world({{Vec3::Zero()}}, 162);
  w.params.dcm[0].nucleus = dcm::Nucleus{};
  give_nuclei(w);
  w.state.dcm.volume[0] = {kBirthVolume, 0.2 * kBirthVolume, 0, 7200};
  SizedWorkspace work(w);
  ASSERT_TRUE(run_until(w, work, 7200));
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
  EXPECT_NEAR(nucleus_volume(w.state, 0) / (0.2 * kBirthVolume / 8), 1, 0.05);
}

TEST(NucleusInACell, HasTheSameBitsForOneAndTwoThreads) {
  std::vector<std::uint64_t> hash;
  const int threads = thread_count();
  for (const int n : {1, 2}) {
    set_threads(n);
    std::vector<TestCell> cells;
    for (int k = 0; k < 12; ++k) cells.push_back({Vec3(23 * (k % 4), 23 * (k / 4), 0)});
    World w = make_test_world(cells, 60, 162);
    w.params.dcm[0].nucleus = dcm::Nucleus{.size = 0.75, .link_young = 0.1};
    give_nuclei(w);
    SizedWorkspace work(w);
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(take_step(w, work, 60).accepted);
    hash.push_back(hash_state(w.state));
  }
  set_threads(threads);
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(NucleusLeak, IsFoundByCell) {
  World w = nucleated_pair();
  EXPECT_EQ(measure_nucleus_leak(w.state).depth_um, 0);
  std::vector<Vec3> node = nucleus_of(w.state, 1);
  node[3] = Vec3(23, 0, 0) + Vec3(0, 0, 40);
  dcm::store_nucleus(node, 1, w.state.dcm);
  const NucleusLeak leak = measure_nucleus_leak(w.state);
  EXPECT_EQ(leak.cell, 1);
  // 40 um from the centre of a mesh of 42 nodes and 12 um: faces stand 10 % inside, nodes 6 % out.
  EXPECT_NEAR(leak.depth_um, 28, 1.3);
}

}  // namespace
}  // namespace acinus::coupling
