/// Small worlds cut out of large ones.

#include "coupling/subworld/subworld.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "coupling/world/cell.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Five shells in a row, a row of spheres on them, all in contact; the middle ones are pulled.
World make_block() {
  std::vector<TestCell> cells;
  for (int k = 0; k < 5; ++k)
    cells.push_back({Vec3(23.9 * k, 0, 0), true, k == 2 ? Vec3(0.1, 0.5, 0.2) : Vec3::Zero()});
  for (int k = 0; k < 5; ++k)
    cells.push_back({Vec3(23.5 * k, 23.5, 0), false, k == 2 ? Vec3(-0.1, 0.2, 0) : Vec3::Zero()});
  World w = make_test_world(cells, 60, 42);
  w.params.numerics.cg = {1e-12, 20000};
  return w;
}
/// Block of cells after three steps, with what only such a state has: last moves and contacts.
World make_stepped_block() {
  World w = make_block();
  SizedWorkspace work(w);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(take_step(w, work, 1).accepted);
  return w;
}
const CellSet kMiddle{{2}, {2}};

TEST(Subworld, NeighboursAreThoseWithinReach) {
  const World w = make_block();
  // Shells of 12 um, 23.9 um apart, nodes up to 5 % beyond the radius; the next but one is 24 um
  // off.
  const CellSet near = find_neighbours(w, kMiddle, 2);
  EXPECT_EQ(near.dcm, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(near.cbm, (std::vector<std::size_t>{1, 3}));
  const CellSet far = find_neighbours(w, kMiddle, 30);
  EXPECT_EQ(far.dcm, (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_EQ(far.cbm, (std::vector<std::size_t>{0, 1, 3, 4}));
  World apart =
      make_test_world({{Vec3::Zero()}, {Vec3(40, 0, 0)}, {Vec3(0, 40, 0), false}}, 60, 42);
  const CellSet none = find_neighbours(apart, {{0}, {}}, 2);
  EXPECT_TRUE(none.dcm.empty() && none.cbm.empty());
}

TEST(Subworld, NothingMovesByItselfThere) {
  World w = make_block();
  w.params.motility.random = true;
  w.params.motility.leader_force = 1;
  w.state.clock.time = 500;
  w.state.dcm.volume[2] = {7000, 14000, 0, 1000};
  w.state.cbm.volume[2] = {7000, 14000, 0, 1000};
  w.state.cbm.strength.set(3, {0, 1, 0, 1000});
  Subworld sub;
  extract_at_rest(w, kMiddle, {{1, 3}, {1, 3}}, sub);
  const State& s = sub.world.state;
  EXPECT_EQ(s.clock.time, 500);
  ASSERT_EQ(dcm::count_cells(s.dcm), 3);
  ASSERT_EQ(s.cbm.n_cell(), 3u);
  const std::size_t lane = std::ranges::find(s.dcm.lineage, 2) - s.dcm.lineage.begin();
  EXPECT_EQ(s.dcm.volume[lane].at(500), 10500);
  EXPECT_EQ(s.dcm.volume[lane].at(1000), 10500);
  EXPECT_EQ(s.cbm.volume[0].at(1000), 10500) << "moving cells come first";
  EXPECT_EQ(s.cbm.strength[2].at(500), 0.5);
  EXPECT_EQ(s.cbm.strength[2].at(1000), 0.5);
  EXPECT_FALSE(sub.world.params.motility.random);
  EXPECT_EQ(sub.world.params.motility.leader_force, 0);
}

TEST(Subworld, ConstrainedCellsDoNotMove) {
  const World w = make_stepped_block();
  Subworld sub;
  extract_at_rest(w, kMiddle, {{1, 3}, {1, 3}}, sub);
  const double start = sub.world.state.clock.time;
  const Settling settling = relax(sub, 60);
  ASSERT_TRUE(settling.ok) << settling.cause;
  EXPECT_GT(settling.steps, 5) << "starts with short steps";
  EXPECT_NEAR(sub.world.state.clock.time, start + 60, 1e-6);
  for (std::int64_t id : {1, 3, 6, 8})
    EXPECT_EQ(nodes_of(sub.world.state, id), nodes_of(w.state, id)) << id;
  for (std::int64_t id : {2, 7})
    EXPECT_GT((nodes_of(sub.world.state, id)[0] - nodes_of(w.state, id)[0]).norm(), 1e-3) << id;
  // Pair forces are equal and opposite, also between moving and constrained cells; the solver
  // leaves 1e-12.
  std::printf("momentum %.1e, torque %.1e\n", sub.world.state.balance.momentum,
              sub.world.state.balance.torque);
  EXPECT_GT(sub.world.state.balance.momentum, 0);
  EXPECT_LT(sub.world.state.balance.momentum, 1e-9);
  EXPECT_LT(sub.world.state.balance.torque, 1e-9);
}

// Newton's method solves for the moving cells beside cells at rest, as a linearly implicit step
// does. If neighbours gave way, moves would be larger.
TEST(Subworld, NewtonHoldsConstrainedCellsToo) {
  const World w = make_stepped_block();
  const auto step_with = [&](Integrator integrator, Subworld& sub) {
    extract_at_rest(w, kMiddle, find_neighbours(w, kMiddle, 3), sub);
    sub.world.params.numerics.adaptive = false;
    sub.world.params.numerics.integrator = integrator;
    sub.world.params.numerics.tolerance = 1e-6;  // Newton stops at a tenth of it
    sub.world.state.clock.step = 30;
    ASSERT_TRUE(take_step(sub.world, sub.work, 30).accepted);
  };
  Subworld linear, newton;
  step_with(Integrator::kLinearlyImplicit, linear);
  step_with(Integrator::kNewton, newton);
  double largest = 0, difference = 0;
  for (std::int64_t id : {2, 7}) {
    const std::vector<Vec3> a = nodes_of(linear.world.state, id),
                            b = nodes_of(newton.world.state, id), before = nodes_of(w.state, id);
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, (a[i] - before[i]).norm());
      difference = std::max(difference, (a[i] - b[i]).norm());
    }
  }
  std::printf("moves %.2e um, off by %.1e of it\n", largest, difference / largest);
  EXPECT_LT(difference, 0.2 * largest);
}

// In a step of length h the pulled cells move by v h. In the large world their neighbours give way
// by (k h / Gamma) of it, which changes what the pulled ones feel by the same factor once more:
// with friction between cells off, the small world is wrong by O(h^2) relative to the move.
TEST(Subworld, MovesAsTheWholeDoesInAShortStep) {
  World w = make_block();
  w.params.dcm_contact.cell_friction = 0;
  for (cbm::Params& p : w.params.cbm) p.cell_friction = 0;
  w.params.interface.friction = 0;
  SizedWorkspace work(w);
  w.state.dcm.pull[2] = Vec3::Zero();
  w.state.cbm.pull.set(2, Vec3::Zero());
  ASSERT_TRUE(run_until(w, work, 10 * 3600));  // neighbours at rest
  w.state.dcm.pull[2] = Vec3(0.1, 0.5, 0.2);
  w.state.cbm.pull.set(2, Vec3(-0.1, 0.2, 0));
  std::vector<double> wrong;
  for (double step : {2.56e-2, 1.28e-2, 6.4e-3}) {
    World whole = w;
    SizedWorkspace whole_work(whole);
    ASSERT_TRUE(take_step(whole, whole_work, step).accepted);
    Subworld sub;
    extract_at_rest(w, kMiddle, find_neighbours(w, kMiddle, 3), sub);
    sub.world.params.numerics.adaptive = false;
    ASSERT_TRUE(take_step(sub.world, sub.work, step).accepted);
    double largest = 0, difference = 0;
    for (std::int64_t id : {2, 7}) {
      const std::vector<Vec3> a = nodes_of(whole.state, id), b = nodes_of(sub.world.state, id),
                              before = nodes_of(w.state, id);
      for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, (a[i] - before[i]).norm());
        difference = std::max(difference, (a[i] - b[i]).norm());
      }
    }
    wrong.push_back(difference / largest);
    std::printf("step %.0e s: moves %.2e um, off by %.1e of it\n", step, largest, wrong.back());
  }
  EXPECT_LT(wrong[2], 1e-3);
  EXPECT_GT(wrong[0] / wrong[1], 1.8) << "4 in the limit";
  EXPECT_GT(wrong[1] / wrong[2], 1.8);
}

TEST(Subworld, WriteBackChangesTheMovingCellsOnly) {
  World w = make_stepped_block();
  const State before = w.state;
  Subworld sub;
  extract_at_rest(w, kMiddle, find_neighbours(w, kMiddle, 3), sub);
  ASSERT_TRUE(relax(sub, 60).ok);
  write_moved(sub, w.state);
  for (std::int64_t id = 0; id < 10; ++id) {
    const bool moved = id == 2 || id == 7;
    EXPECT_EQ(nodes_of(w.state, id), nodes_of(moved ? sub.world.state : before, id)) << id;
    EXPECT_EQ(nodes_of(w.state, id) == nodes_of(before, id), !moved) << id;
  }
  for_each_cell(w.state, [&](const Cell& c) {
    const std::int64_t id = lineage_of(w.state, c);
    const Address a = c.deformable ? dcm::node_address(w.state.dcm, c.at, 5)
                                   : cbm::cell_address(w.state.dcm.n_row(), c.at);
    const Vec3 now = load_point(w.state.last_move.data(), a),
               then = load_point(before.last_move.data(), a);
    EXPECT_EQ(now == then, id != 2 && id != 7) << id;
  });
  EXPECT_EQ(w.state.clock.time, before.clock.time);
  EXPECT_EQ(w.state.clock.accepted, before.clock.accepted);
  EXPECT_EQ(w.state.cbm.touching, before.cbm.touching) << "no contact was lost";
  EXPECT_FALSE(before.cbm.touching.empty());
  SizedWorkspace work(w);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(take_step(w, work, 60).accepted);
}

TEST(Subworld, WriteBackTakesOverContactsMadeAndLost) {
  World w = make_test_world({{Vec3::Zero(), false},
                             {Vec3(23, 0, 0), false},
                             {Vec3(46, 0, 0), false},
                             {Vec3(69, 0, 0), false}});
  w.state.cbm.touching = {{0, 1}, {1, 2}, {2, 3}};
  Subworld sub;
  extract_at_rest(w, {{}, {1}}, {{}, {0, 2}}, sub);
  ASSERT_EQ(sub.world.state.cbm.lineage, (std::vector<std::int64_t>{1, 0, 2}));
  sub.world.state.cbm.touching = {{0, ~4}, {0, 2}, {1, 2}};  // 1 lost 0, met a wall; 0 meets 2
  write_moved(sub, w.state);
  EXPECT_EQ(w.state.cbm.touching, (std::vector<std::pair<int, int>>{{1, ~4}, {1, 2}, {2, 3}}))
      << "contacts between constrained cells are not looked at";
}

}  // namespace
}  // namespace acinus::coupling
