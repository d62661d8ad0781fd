/// Steps in which a process has the points of its own cells and of near ones only.

#include "coupling/step/near_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/life/life.hpp"
#include "coupling/life/mesh_health.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/workspace_size.hpp"
#include "tests/coupling/lives.hpp"
#include "tests/coupling/worlds.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::coupling {
namespace {

constexpr int kRowShells = 72, kRowSpheres = 216;

/// Rows of cells of both models, longer than a process reaches. Some are pulled.
World make_rows(const Ranks& ranks, bool extrapolate) {
  std::vector<TestCell> cells;
  for (int k = 0; k < kRowShells; ++k)
    cells.push_back({Vec3(23.9 * k, 0, 0), true, k % 5 == 0 ? Vec3(1, 0.5, 0) : Vec3::Zero()});
  for (int k = 0; k < kRowSpheres; ++k)
    cells.push_back(
        {Vec3(7.9 * k, 15.9, 0), false, k % 7 == 0 ? Vec3(0, 0.2, 0.1) : Vec3::Zero(), 4});
  World world = make_test_world(cells, 60, 42);
  world.params.numerics.extrapolate = extrapolate;
  world.params.numerics.adaptive = extrapolate;
  world.ranks = ranks;
  return world;
}

/// Takes steps; at the end every process has all.
void take_steps(int n, World& world, Workspace& work) {
  size_workspace(world, work);
  for (int k = 0; k < n; ++k) ASSERT_TRUE(take_step(world, work, 60).accepted);
}

void complete(World& world, Workspace& work) {
  complete_points(world, work);
  complete_contacts(world.ranks, world.state);
  complete_cells(world.ranks, world.state);
}

TEST(NearCells, GiveTheStepsOfAllCells) {
  for (const bool extrapolate : {false, true}) {
    World alone = make_rows(Ranks::serial(), extrapolate);
    Workspace work;
    take_steps(8, alone, work);
    for (const Sharing sharing : {Sharing::kBalanced, Sharing::kRandom}) {
      World shared = make_rows(Ranks::world(), extrapolate);
      shared.sharing = sharing;
      Workspace of_part;
      take_steps(8, shared, of_part);
      EXPECT_EQ(shared.state.near_set != 0, !shared.ranks.is_alone());
      complete(shared, of_part);
      EXPECT_EQ(hash_state(shared.state), hash_state(alone.state));
    }
  }
}

TEST(NearCells, AreTheOnlyOnesWithPointsBesideOwnOnes) {
  World world = make_rows(Ranks::world(), false);
  Workspace work;
  take_steps(2, world, work);
  const State& s = world.state;
  if (s.near_set == 0) return;
  int n_near = 0, n_own = 0, wrong = 0;
  for_each_cell(s, [&](const Cell& c) {
    const bool near = std::ranges::binary_search(s.near, c.index),
               own = s.cell_holder[c.index] == world.ranks.rank();
    n_near += near ? 1 : 0;
    n_own += own ? 1 : 0;
    double sum = c.deformable ? 0 : s.cbm.volume[c.at].to;
    for_each_point(s, c, [&](Address a) { sum += load_point(position_of(s, a), 0).norm(); });
    if ((near || own) != (sum > 0)) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(n_near, 0);
  EXPECT_LT(n_near, n_own / 2);
}

TEST(NearCells, OfAnotherStateAreFoundAnew) {
  World world = make_rows(Ranks::world(), false);
  Workspace work;
  take_steps(2, world, work);
  const State kept = world.state;
  complete_points(world, work);
  const auto step = [&] {
    ASSERT_TRUE(take_step(world, work, 60).accepted);
    complete(world, work);
  };
  step();
  const std::uint64_t hash = hash_state(world.state);
  world.state = kept;
  step();
  EXPECT_EQ(hash_state(world.state), hash);
}

TEST(NearCells, SpheresThatAreDueAreKnownToAll) {
  World world = make_rows(Ranks::world(), false);
  world.params.life.type = {cycle_params()};
  begin_life(world);
  Workspace work;
  take_steps(1, world, work);
  for (const double hours : {10.0, 30.0, 40.0}) {
    world.state.clock.time = 3600 * hours;
    const Plan plan = make_plan(world, work);
    World all = world;
    complete_near(all.ranks, all.state);
    const Plan expected = make_plan(all, work);
    ASSERT_EQ(plan.divide.size(), expected.divide.size());
    EXPECT_EQ(plan.divide.empty(), hours < 15);
    for (std::size_t k = 0; k < plan.divide.size(); ++k)
      EXPECT_EQ(plan.divide[k].index, expected.divide[k].index);
  }
}

/// Bits of what a frame measures: cells everywhere, nodes at the root.
std::vector<double> measure(World& world, Workspace& work) {
  observe(world, work);
  std::vector<double> all;
  for (const CellMeasure& c : measure_cells(world, work)) {
    all.insert(all.end(), {c.volume, c.area, c.contact_area, c.contact_force, c.normal_force,
                           static_cast<double>(c.contacts), c.center.x()});
    all.insert(all.end(), c.stress.begin(), c.stress.end());
  }
  const std::size_t n = all.size();
  visit_nodes(world, work, [&](std::span<const NodeValue> nodes) {
    for (const NodeValue& v : nodes)
      all.insert(all.end(), {v.position.y(), v.force.x(), v.pressure, v.tension});
  });
  EXPECT_EQ(all.size() - n, world.ranks.is_root() ? 4U * 42 * kRowShells : 0);
  return all;
}

TEST(NearCells, GiveTheMeasuresOfAllCells) {
  World alone = make_rows(Ranks::serial(), false);
  Workspace work;
  take_steps(3, alone, work);
  const std::vector<double> expected = measure(alone, work);
  for (const Sharing sharing : {Sharing::kBalanced, Sharing::kRandom}) {
    World shared = make_rows(Ranks::world(), false);
    shared.sharing = sharing;
    Workspace of_part;
    take_steps(3, shared, of_part);
    EXPECT_EQ(shared.state.near_set != 0, !shared.ranks.is_alone());
    refresh_near_cells(shared, of_part);
    const std::vector<double> found = measure(shared, of_part);
    EXPECT_TRUE(std::ranges::equal(found, std::span(expected).first(found.size())));
    EXPECT_EQ(shared.state.near_set != 0, !shared.ranks.is_alone());
  }
}

/// Rows in which some cells of both models are about to divide.
World make_mothers(const Ranks& ranks) {
  World world = make_rows(ranks, false);
  world.params.life.type = {cycle_params()};
  world.params.life.remesh = false;
  world.state.next_lineage = kRowShells + kRowSpheres;
  begin_life(world);
  State& s = world.state;
  for_each_cell(s, [&](const Cell& c) {
    const double now = volume_of(s, c).at(s.clock.time);
    volume_of(s, c) = Ramp::constant(now);
    if (lineage_of(s, c) % 24 == 5) s.cycle[c.index].birth_volume = now / 2;
  });
  return world;
}

TEST(NearCells, DivideWithoutPointsOfAllCells) {
  const auto divide = [](World& world, Workspace& work) {
    take_steps(2, world, work);
    const LifeReport report = live(world, work);
    EXPECT_EQ(count_events(report, EventKind::kDivision), (kRowShells + kRowSpheres) / 24);
    return report;
  };
  World alone = make_mothers(Ranks::serial());
  Workspace work;
  const LifeReport expected = divide(alone, work);
  ASSERT_TRUE(take_step(alone, work, 60).accepted);
  for (const Sharing sharing : {Sharing::kBalanced, Sharing::kRandom}) {
    World shared = make_mothers(Ranks::world());
    shared.sharing = sharing;
    Workspace of_part;
    const LifeReport report = divide(shared, of_part);
    EXPECT_EQ(shared.state.near_set, shared.ranks.is_alone() ? 0 : kOwnPoints);
    ASSERT_EQ(report.divisions.size(), expected.divisions.size());
    for (std::size_t k = 0; k < report.divisions.size(); ++k) {
      EXPECT_EQ(report.divisions[k].settled_shift, expected.divisions[k].settled_shift);
      EXPECT_EQ(report.divisions[k].outside, expected.divisions[k].outside);
      EXPECT_EQ(report.events[k].message, expected.events[k].message);
    }
    ASSERT_TRUE(take_step(shared, of_part, 60).accepted);
    complete(shared, of_part);
    EXPECT_EQ(hash_state(shared.state), hash_state(alone.state));
  }
}

/// Moves a node of some meshes almost onto the next one, on all processes that have its cell.
void spoil_meshes(World& world) {
  State& s = world.state;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (s.dcm.lineage[lane] % 20 != 3) continue;
    if (!holds_points(world.ranks, s, lane) && !std::ranges::binary_search(s.near, lane)) continue;
    const geometry::Topology& t = *s.dcm.group[lane / kLanes].topology;
    std::vector<Vec3> node;
    dcm::copy_nodes(s.dcm, lane, node);
    node[20] = 0.02 * node[20] + 0.98 * node[t.ring[t.ring_start[20]]];
    dcm::store_nodes(node, lane, s.dcm);
  }
}

TEST(NearCells, MendMeshesWithoutPointsOfAllCells) {
  const auto mend = [](World& world, Workspace& work) {
    world.params.life.grid = 60;
    take_steps(2, world, work);
    spoil_meshes(world);
    LifeReport report;
    mend_meshes(world, work, report);
    EXPECT_EQ(count_events(report, EventKind::kRemeshed), 4);
    return report;
  };
  World alone = make_rows(Ranks::serial(), false);
  Workspace work;
  const LifeReport expected = mend(alone, work);
  ASSERT_TRUE(take_step(alone, work, 60).accepted);
  for (const Sharing sharing : {Sharing::kBalanced, Sharing::kRandom}) {
    World shared = make_rows(Ranks::world(), false);
    shared.sharing = sharing;
    Workspace of_part;
    const LifeReport report = mend(shared, of_part);
    EXPECT_EQ(shared.state.near_set, shared.ranks.is_alone() ? 0 : kOwnPoints);
    ASSERT_EQ(report.events.size(), expected.events.size());
    for (std::size_t k = 0; k < report.events.size(); ++k)
      EXPECT_EQ(report.events[k].message, expected.events[k].message);
    ASSERT_TRUE(take_step(shared, of_part, 60).accepted);
    complete(shared, of_part);
    EXPECT_EQ(hash_state(shared.state), hash_state(alone.state));
  }
}

}  // namespace
}  // namespace acinus::coupling
