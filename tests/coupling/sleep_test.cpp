/// Cells that rest are left out until something pushes them.

#include "coupling/sleep/sleep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

/// Four cells of each model pressed together by a capsule.
World make_pressed_clump(bool sleep) {
  World w = make_test_world(checkered_cube(23.0), 60, 42);
  contact::Capsule shell;
  shell.center = Vec3::Constant(11.5);
  shell.radius = 32;
  shell.min_radius = 26;
  shell.speed = 6.0 / 1800;
  w.params.boundary.capsules = {shell};
  w.params.sleep = {sleep, 600, 1e-3};
  return w;
}

/// Steps and looks as a run does.
void run_for(World& w, Workspace& work, double duration) {
  const double end = w.state.clock.time + duration;
  AwakePart awake;
  while (w.state.clock.time < end - 1e-6) {
    const double left = std::min(end - w.state.clock.time, time_to_event(w));
    const StepResult r = advance(w, work, awake, left);
    ASSERT_TRUE(r.accepted) << r.cause;
    live(w, work);
  }
}

std::map<std::int64_t, std::vector<Vec3>> places(const State& s) {
  std::map<std::int64_t, std::vector<Vec3>> all;
  for_each_cell(s, [&](const Cell& c) {
    std::vector<Vec3>& node = all[lineage_of(s, c)];
    if (c.deformable)
      dcm::copy_nodes(s.dcm, c.at, node);
    else
      node = {center_of(s, c)};
  });
  return all;
}
bool is_asleep(const State& s, std::int64_t id) {
  const std::size_t index = index_cells(s).at(id).index;
  return index < s.asleep.size() && s.asleep[index] != 0;
}
std::map<std::int64_t, double> pressures(const World& w, Workspace& work) {
  observe(w, work);
  std::map<std::int64_t, double> p;
  for (const CellMeasure& m : measure_cells(w, work)) p[m.id] = m.pressure;
  return p;
}

TEST(Sleep, ARestingClumpFallsAsleepAndMovesOnFromCheckToCheck) {
  World w = make_pressed_clump(true);
  SizedWorkspace work(w);
  EXPECT_EQ(time_to_event(w), 600);
  run_for(w, work, 600);
  EXPECT_LT(count_asleep(w.state), 8) << "pressed just now";
  run_for(w, work, 12 * 3600);
  ASSERT_EQ(count_asleep(w.state), 8);
  const auto start = places(w.state);
  run_for(w, work, 200);
  const auto middle = places(w.state);
  run_for(w, work, 399);
  const auto end = places(w.state);
  EXPECT_EQ(count_asleep(w.state), 8);
  double moved = 0, off = 0;
  for (const auto& [id, x] : start)
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Vec3 way = end.at(id)[k] - x[k];
      moved = std::max(moved, way.norm());
      off = std::max(off, (middle.at(id)[k] - x[k] - way * (200.0 / 599)).norm());
    }
  EXPECT_GT(moved, 1e-4) << "what creeps goes on creeping";
  EXPECT_LT(off, 1e-9 * moved);
}

TEST(Sleep, PressuresOfAClumpAtRestAreThoseWithoutSleep) {
  World awake = make_pressed_clump(false);
  Workspace work, tired_work;
  size_workspace(awake, work);
  run_for(awake, work, 24 * 3600);
  World tired = awake;
  tired.params.sleep.enabled = true;
  size_workspace(tired, tired_work);
  run_for(awake, work, 3 * 3600);
  run_for(tired, tired_work, 3 * 3600);
  EXPECT_EQ(count_asleep(tired.state), 8);
  EXPECT_EQ(count_asleep(awake.state), 0);
  const auto p = pressures(tired, tired_work), q = pressures(awake, work);
  double worst = 0;
  for (const auto& [id, pressure] : q) {
    EXPECT_GT(pressure, 0.01);
    worst = std::max(worst, std::abs(p.at(id) / pressure - 1));
  }
  std::printf("pressures off by %.2f %%\n", 100 * worst);
  EXPECT_LT(worst, 0.01);
}

// A clump that creeps falls asleep before it has come to rest. Its pressures are then off by what
// its cells may be out of balance by, up to the limit, and so may their neighbours be.
TEST(Sleep, PressuresOfAClumpThatCreepsAreOffByAFewTimesTheLimit) {
  World awake = make_pressed_clump(false), tired = make_pressed_clump(true);
  Workspace work, tired_work;
  size_workspace(awake, work);
  size_workspace(tired, tired_work);
  run_for(awake, work, 6 * 3600);
  run_for(tired, tired_work, 6 * 3600);
  EXPECT_GE(count_asleep(tired.state), 4);
  const auto p = pressures(tired, tired_work), q = pressures(awake, work);
  double off = 0;
  for (const auto& [id, pressure] : q) off = std::max(off, std::abs(p.at(id) - pressure));
  std::printf("pressures off by %.2e kPa at a limit of 1e-3\n", off);
  EXPECT_LT(off, 2 * 1e-3);
}

TEST(Sleep, APulledCellWakesAtTheNextLook) {
  World w = make_test_world({{Vec3::Zero()},
                             {Vec3(23.8, 0, 0)},
                             {Vec3(47.6, 0, 0)},
                             {Vec3(0, 23.8, 0), false},
                             {Vec3(0, 47, 0), false},
                             {Vec3(0, 200, 0), false}},
                            60, 42);
  w.params.sleep = {true, 600, 1e-3};
  SizedWorkspace work(w);
  run_for(w, work, 4 * 3600);
  ASSERT_EQ(count_asleep(w.state), 6);
  // 5 nN over 4 pi (12 um)^2 are 2.8e-3 kPa: above twice the limit.
  const auto index = index_cells(w.state);
  w.state.dcm.pull[index.at(2).at] = Vec3(0, 0, 5);
  w.state.cbm.pull.set(index.at(5).at, Vec3(0, 0, 5));
  run_for(w, work, 599);
  EXPECT_EQ(count_asleep(w.state), 6) << "asleep until the look";
  run_for(w, work, 1);
  EXPECT_FALSE(is_asleep(w.state, 2));
  EXPECT_FALSE(is_asleep(w.state, 5));
  for (std::int64_t id : {3, 4}) EXPECT_TRUE(is_asleep(w.state, id)) << "touches none of them";
  const auto before = places(w.state);
  run_for(w, work, 600);
  const auto after = places(w.state);
  EXPECT_GT((after.at(2)[0] - before.at(2)[0]).norm(), 0.1);
  // 5 nN against 0.5 nN s/um^3 times the surface for 600 s
  EXPECT_NEAR((after.at(5)[0] - before.at(5)[0]).z(), 5.0 / (0.5 * 4 * kPi * 144) * 600, 1e-3);
}

TEST(Sleep, CellsThatGrowOrAreJustBornStayAwake) {
  World w = make_living_world({{Vec3::Zero()}, {Vec3(60, 0, 0), false}, {Vec3(120, 0, 0), false}});
  w.params.sleep = {true, 600, 1e-3};
  w.params.numerics.adaptive = false;
  LifeRule rest;
  rest.cells = {2};
  w.params.life.rule = {rest};
  begin_life(w);
  w.state.dcm.volume[0] = Ramp::constant(kBirthVolume);  // does not grow, but remembers its birth
  w.state.cycle[0].duration = 0;
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, 0, node);
  w.state.dcm.birth[0] =
      dcm::make_birth_shape(geometry::shared_icosphere(42), node, 12, 1, {1, 0, 0, 5000});
  SizedWorkspace work(w);
  run_for(w, work, 4800);
  EXPECT_EQ(count_asleep(w.state), 1);
  EXPECT_TRUE(is_asleep(w.state, 2));
  run_for(w, work, 1200);
  EXPECT_TRUE(is_asleep(w.state, 0)) << "at the look after it has forgotten its birth";
  EXPECT_FALSE(is_asleep(w.state, 1));
  w.params.life.rule.clear();
  w.params.life.rule.emplace_back().until = 0;  // no cell rests from now on
  run_for(w, work, 600);
  EXPECT_FALSE(is_asleep(w.state, 2)) << "grows again";
}

// A capsule that opens lets cells go that were asleep.
TEST(Sleep, CellsWakeWhenAWallOpens) {
  World w = make_pressed_clump(true);
  const double opens = 14 * 3600;  // on the grid of sleep
  w.params.boundary.capsules[0].opens = opens;
  Simulation simulation(std::move(w));
  ASSERT_TRUE(simulation.run_until(opens - 100).ok);
  const State& s = simulation.world().state;
  ASSERT_EQ(count_asleep(s), 8);
  const auto before = places(s);
  ASSERT_TRUE(simulation.run_until(opens + 300).ok);
  EXPECT_EQ(count_asleep(s), 0);
  double moved = 0;
  for (const auto& [id, x] : places(s)) moved = std::max(moved, (x[0] - before.at(id)[0]).norm());
  std::printf("moved %.2g um\n", moved);
  EXPECT_GT(moved, 0.05);
}

TEST(Sleep, CellsWithoutALastMoveStayWhileTimePasses) {
  World w = make_pressed_clump(true);
  SizedWorkspace work(w);
  run_for(w, work, 12 * 3600);
  ASSERT_EQ(count_asleep(w.state), 8);
  w.state.clock.last_step = 0;  // as after a change of a device
  const auto before = places(w.state);
  AwakePart awake;
  for (int k = 0; k < 2; ++k) ASSERT_TRUE(advance(w, work, awake, 30).accepted);
  EXPECT_EQ(places(w.state), before);
}

TEST(Sleep, GoesOnFromASavedStateBitForBit) {
  World w = make_pressed_clump(true);
  SizedWorkspace work(w);
  run_for(w, work, 1500);
  World resumed = w;
  SizedWorkspace fresh(resumed);
  run_for(w, work, 2 * 3600);
  run_for(resumed, fresh, 2 * 3600);
  EXPECT_GT(count_asleep(w.state), 0);
  EXPECT_EQ(hash_state(resumed.state), hash_state(w.state));
  EXPECT_EQ(resumed.state.asleep, w.state.asleep);
}

}  // namespace
}  // namespace acinus::coupling
