/// Order to stop that comes while cells divide, or while new meshes settle.

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/stop.hpp"
#include "coupling/simulation.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

World make_mothers() {
  const double d = 2 * kMotherRadius;
  World w = make_living_world({{Vec3::Zero(), true, Vec3::Zero(), kMotherRadius},
                               {Vec3(d, 0, 0), true, Vec3::Zero(), kMotherRadius},
                               {Vec3(0, d, 0), false, Vec3::Zero(), kMotherRadius}},
                              162);
  begin_with_mothers(w);
  return w;
}

TEST(LifeStop, DivisionBegunIsUndoneAndDoneAgainLater) {
  World through = make_mothers(), stopped = through;
  EXPECT_EQ(count_events(look(through, 0), EventKind::kDivision), 3);
  const std::uint64_t before = hash_state(stopped.state);
  {
    const WallTimeLimit passed(0);
    const LifeReport report = look(stopped, 0);
    EXPECT_TRUE(report.interrupted);
    EXPECT_TRUE(report.events.empty());
  }
  EXPECT_EQ(hash_state(stopped.state), before);
  EXPECT_EQ(stopped.state.clock.due, EventsDue::kAll);
  EXPECT_EQ(count_events(look(stopped, 0), EventKind::kDivision), 3);
  EXPECT_EQ(stopped.state.clock.due, EventsDue::kNone);
  EXPECT_EQ(hash_state(stopped.state), hash_state(through.state));
}

TEST(LifeStop, MeshBegunToBeMendedIsPutBack) {
  World through = make_living_world({{Vec3::Zero()}, {Vec3(23.5, 0, 0)}}, 162);
  const geometry::Topology& t = *through.state.dcm.group[0].topology;
  double* x = through.state.dcm.position.data();
  const Address node = dcm::node_address(through.state.dcm, 0, 20);
  const Address next = dcm::node_address(through.state.dcm, 0, t.ring[t.ring_start[20]]);
  store_point(x, node, 0.02 * load_point(x, node) + 0.98 * load_point(x, next));
  through.state.clock.last_step = 60;
  World stopped = through;
  EXPECT_EQ(count_events(look(through, 600), EventKind::kRemeshed), 1);
  stopped.state.clock.time = 600;
  const std::uint64_t before = hash_state(stopped.state);
  {
    const WallTimeLimit passed(0);
    const LifeReport report = look(stopped, 600);
    EXPECT_TRUE(report.interrupted);
    EXPECT_TRUE(report.events.empty());
  }
  EXPECT_EQ(hash_state(stopped.state), before);
  EXPECT_EQ(stopped.state.clock.due, EventsDue::kMeshes);
  EXPECT_EQ(count_events(look(stopped, 600), EventKind::kRemeshed), 1);
  EXPECT_EQ(hash_state(stopped.state), hash_state(through.state));
}

TEST(LifeStop, SleepersAreLookedAtAgain) {
  World through = make_test_world({{Vec3::Zero()}, {Vec3(23.5, 0, 0)}, {Vec3(0, 23.5, 0), false}});
  through.params.motility.random = false;
  through.params.sleep = {true, 600, 1};
  Workspace work, stopped_work;
  size_workspace(through, work);
  ASSERT_TRUE(take_step(through, work, 600).accepted);
  through.state.clock.time = 600;
  World stopped = through;
  size_workspace(stopped, stopped_work);
  EXPECT_FALSE(live(through, work).interrupted);
  EXPECT_EQ(count_asleep(through.state), 3);
  const std::uint64_t before = hash_state(stopped.state);
  {
    const WallTimeLimit passed(0);
    EXPECT_TRUE(live(stopped, stopped_work).interrupted);
  }
  EXPECT_EQ(hash_state(stopped.state), before);
  EXPECT_EQ(stopped.state.clock.due, EventsDue::kSleep);
  EXPECT_FALSE(live(stopped, stopped_work).interrupted);
  EXPECT_EQ(stopped.state.clock.due, EventsDue::kNone);
  EXPECT_EQ(hash_state(stopped.state), hash_state(through.state));
}

// Limits of a few milliseconds fall into steps, divisions and the settling of daughters alike.
TEST(LifeStop, ManyStopsLeaveTheSameBits) {
  constexpr double kEndOfStops = 1200;  // s
  Simulation through(make_mothers()), stopped(make_mothers());
  EXPECT_TRUE(through.run_until(kEndOfStops).ok);
  int in_steps = 0, in_events = 0, divisions = 0;
  const Observer observer{.life = [&](const LifeReport& report) {
    divisions += count_events(report, EventKind::kDivision);
    EXPECT_EQ(count_events(report, EventKind::kSettlingFailed), 0);
  }};
  for (double wall = 2e-3;; wall *= 1.1) {
    const WallTimeLimit limit(wall);
    if (stopped.run_until(kEndOfStops, observer).ok) break;
    (stopped.world().state.clock.due == EventsDue::kNone ? in_steps : in_events) += 1;
  }
  std::printf("stopped %d times in a step, %d times in the events after it\n", in_steps, in_events);
  EXPECT_EQ(divisions, 3);
  EXPECT_GT(in_steps, 0);
  EXPECT_GT(in_events, 0);
  EXPECT_EQ(hash_state(stopped.world().state), hash_state(through.world().state));
}

}  // namespace
}  // namespace acinus::coupling
