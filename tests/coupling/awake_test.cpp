/// Steps of a world in which cells sleep.

#include "coupling/sleep/partial_step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

/// @return the cells awake as a world of their own
AwakePart run_steps(World& w, Workspace& work, int n) {
  AwakePart part;
  for (int k = 0; k < n; ++k) EXPECT_TRUE(advance(w, work, part, 60).accepted);
  return part;
}

/// Six shells in a row, a row of spheres on them, all in contact; two of each are pulled. Stepped
/// once, so that contacts are known.
World make_rows() {
  std::vector<TestCell> cells;
  for (int k = 0; k < 6; ++k)
    cells.push_back({Vec3(23.9 * k, 0, 0), true, k < 2 ? Vec3(0.1, 0.5, 0.2) : Vec3::Zero()});
  for (int k = 0; k < 6; ++k)
    cells.push_back({Vec3(23.5 * k, 23.5, 0), false, k < 2 ? Vec3(-0.1, 0.2, 0) : Vec3::Zero()});
  World w = make_test_world(cells, 60, 42);
  w.params.numerics.cg = {1e-12, 20000};
  SizedWorkspace work(w);
  run_steps(w, work, 1);
  return w;
}
/// All but the pulled ones.
void put_to_sleep(State& s) {
  s.asleep.assign(s.dcm.n_lane() + s.cbm.n_cell(), 0);
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t id = lineage_of(s, c);
    s.asleep[c.index] = id % 6 >= 2 ? 1 : 0;
  });
}
const CellSet kAwake{{0, 1}, {0, 1}};

TEST(AwakePart, ContainsWhatMayTouchThoseAwakeAndWhatTouchesTheSpheresAmongThem) {
  World w = make_rows();
  put_to_sleep(w.state);
  // Shell 2 and sphere 2 may touch; sphere 2 has contacts with sphere 3 and shells 2 and 3.
  const CellSet ring = find_ring(w, kAwake);
  EXPECT_EQ(ring.dcm, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(ring.cbm, (std::vector<std::size_t>{2, 3}));
  World shells = w;
  for (double& x : shells.state.cbm.position) x += 1000;
  EXPECT_EQ(find_ring(shells, {{0, 1}, {}}).dcm, (std::vector<std::size_t>{2}));
}

TEST(AwakePart, StepsAsTheWholeWorldDoesWithItsSleepersConstrained) {
  World part = make_rows();
  put_to_sleep(part.state);
  World whole = part;
  Workspace work, whole_work;
  whole_work.constraint.cell = whole.state.asleep;
  whole_work.constraint.prescribed_velocity = true;
  whole.state.asleep.clear();
  size_workspace(part, work);
  size_workspace(whole, whole_work);
  const AwakePart awake = run_steps(part, work, 5);
  run_steps(whole, whole_work, 5);
  ASSERT_TRUE(awake.subworld);
  EXPECT_LT(awake.subworld->world.state.cbm.n_cell(), 6u);
  double off = 0, moved = 0;
  const World start = make_rows();
  for_each_cell(part.state, [&](const Cell& c) {
    const Vec3 x = center_of(part.state, c);
    off = std::max(off, (x - center_of(whole.state, c)).norm());
    moved = std::max(moved, (x - center_of(start.state, c)).norm());
  });
  std::printf("moved by %.3g um, off by %.3g um\n", moved, off);
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(off, 1e-8 * moved) << "ten thousand times the solver's tolerance";
  EXPECT_EQ(part.state.cbm.touching, whole.state.cbm.touching);
  EXPECT_EQ(part.state.clock.accepted, 1 + 5);
}

TEST(AwakePart, MakesNoDifferenceToTheBitWhereverItsWorkspaceWasMade) {
  World w = make_rows();
  put_to_sleep(w.state);
  SizedWorkspace work(w);
  run_steps(w, work, 3);
  World again = w;
  SizedWorkspace fresh(again);
  run_steps(w, work, 3);
  run_steps(again, fresh, 3);
  EXPECT_EQ(hash_state(again.state), hash_state(w.state));
}

TEST(AwakePart, IsLeftOutWhenAllSleepAndMoveOn) {
  World w = make_rows();
  w.state.asleep.assign(w.state.dcm.n_lane() + w.state.cbm.n_cell(), 1);
  const World before = w;
  SizedWorkspace work(w);
  AwakePart none;
  const StepResult r = advance(w, work, none, 45);
  EXPECT_TRUE(r.accepted);
  EXPECT_EQ(r.step, 45);
  EXPECT_EQ(w.state.clock.time, before.state.clock.time + 45);
  const std::vector<double> from = gather_positions(before.state), to = gather_positions(w.state);
  double moved = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    moved = std::max(moved, std::abs(to[k] - from[k]));
    ASSERT_NEAR(to[k] - from[k], 45.0 / 60 * before.state.last_move[k], 1e-12);
  }
  EXPECT_GT(moved, 1e-3);
}

/// Two shells in contact, pulled the same way, and a third one far off. In a matrix both move as if
/// they were one; what rubs on a partner that stands would hardly move at all.
World make_pulled_pair() {
  World w = make_test_world({{Vec3::Zero(), true, Vec3(0, 0, 0.02)},
                             {Vec3(23.9, 0, 0), true, Vec3(0, 0, 0.02)},
                             {Vec3(200, 0, 0), true}},
                            60, 42);
  w.params.numerics.cg = {1e-10, 20000};
  SizedWorkspace work(w);
  run_steps(w, work, 600);
  return w;
}

TEST(AwakePart, SleepersMoveAlongWithThoseAwake) {
  World awake = make_pulled_pair();
  World tired = awake;
  tired.state.asleep = {0, 1, 0, 0, 0, 0, 0, 0};
  Workspace work, tired_work;
  size_workspace(awake, work);
  size_workspace(tired, tired_work);
  const Vec3 start[] = {dcm::cell_center(awake.state.dcm, 0), dcm::cell_center(awake.state.dcm, 1)};
  run_steps(awake, work, 30);
  ASSERT_TRUE(set_sleepers_velocity(tired, tired_work, 1800).ok);
  run_steps(tired, tired_work, 30);
  for (std::size_t lane : {0, 1}) {
    const Vec3 way = dcm::cell_center(awake.state.dcm, lane) - start[lane];
    const Vec3 moved = dcm::cell_center(tired.state.dcm, lane) - start[lane];
    std::printf("moved by %.3g um, off by %.3g um\n", way.norm(), (moved - way).norm());
    EXPECT_GT(way.norm(), 0.05);
    EXPECT_LT((moved - way).norm(), 0.02 * way.norm());
  }
}

}  // namespace
}  // namespace acinus::coupling
