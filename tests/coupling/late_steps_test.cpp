/// Late cells take shorter steps of their own.

#include "coupling/subworld/late_steps.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/threads.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/step/near_cells.hpp"
#include "tests/coupling/worlds.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::coupling {
namespace {

constexpr int kLineShells = 72, kLineSpheres = 328, kPulledCell = 30;
constexpr double kMinute = 60;
const Vec3 kPull(0, -20, 0);  // nN

/// Rows of cells of both models. One deformable cell is pulled away from the rows.
World make_lines(double max_move, const Ranks& ranks = Ranks::serial()) {
  std::vector<TestCell> cells;
  for (int k = 0; k < kLineShells; ++k)
    cells.push_back({Vec3(23.9 * k, 0, 0), true, k == kPulledCell ? kPull : Vec3::Zero()});
  for (int k = 0; k < kLineSpheres; ++k)
    cells.push_back({Vec3(7.9 * k, 40, 0), false, Vec3::Zero(), 4});
  World world = make_test_world(cells, kMinute, 42);
  world.params.numerics.adaptive = true;
  world.params.numerics.tolerance = 100;  // displacement alone makes cells late
  world.params.numerics.max_move = max_move;
  world.params.numerics.cg = {1e-9, 20000};
  world.ranks = ranks;
  return world;
}

Vec3 pulled_center(const World& w) {
  for (std::size_t l = 0; l < w.state.dcm.n_lane(); ++l)
    if (w.state.dcm.lineage[l] == kPulledCell) return dcm::cell_center(w.state.dcm, l);
  return Vec3::Zero();
}

TEST(LateSteps, KeepTheStepOfAllOthers) {
  World w = make_lines(0.3);
  SizedWorkspace work(w);
  AwakePart awake;
  const StepResult step = advance(w, work, awake, kMinute);
  ASSERT_TRUE(step.accepted) << step.cause;
  EXPECT_EQ(step.step, kMinute);
  EXPECT_EQ(step.rejections, 0);
  EXPECT_EQ(w.state.clock.solves, 1);
  EXPECT_EQ(w.state.clock.shortened, 1);
  EXPECT_TRUE(work.late.empty());

  World all = make_lines(0.3);
  SizedWorkspace work_of_all(all);
  EXPECT_LT(take_step(all, work_of_all, kMinute).step, kMinute) << "without steps of its own";
}

TEST(LateSteps, NotWhereManyCellsAreLate) {
  World w = make_lines(0.3);
  for (Vec3& pull : w.state.dcm.pull) pull = kPull;
  SizedWorkspace work(w);
  AwakePart awake;
  EXPECT_LT(advance(w, work, awake, kMinute).step, kMinute);
}

TEST(LateSteps, ErrLessTheShorterTheyAre) {
  const auto center_after = [](double max_move, double step) {
    World w = make_lines(max_move);
    w.params.numerics.max_step = step;
    SizedWorkspace work(w);
    AwakePart awake;
    const LoopResult done =
        run_loop({.time_left = time_left_until(w.state.clock, kMinute),
                  .advance = [&](double limit) { return advance(w, work, awake, limit); }});
    EXPECT_TRUE(done.ok) << done.last.cause;
    return pulled_center(w);
  };
  const Vec3 exact = center_after(0, 0.5);
  double last = (center_after(0, kMinute) - exact).norm();
  const double way = (exact - Vec3(23.9 * kPulledCell, 0, 0)).norm();
  std::printf("way %.3f um; error of one step %.4f um", way, last);
  for (const double limit : {0.3, 0.1, 0.03}) {
    const double error = (center_after(limit, kMinute) - exact).norm();
    std::printf(", %.4f um with %.2f edges", error, limit);
    EXPECT_LT(error, last);
    last = error;
  }
  std::printf("\n");
}

TEST(LateSteps, HaveTheSameBitsForAnyNumberOfThreadsAndProcesses) {
  const auto hash_after = [](const Ranks& ranks, Sharing sharing, int threads) {
    set_threads(threads);
    World w = make_lines(0.3, ranks);
    w.sharing = sharing;
    Workspace work;
    size_workspace(w, work);
    AwakePart awake;
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(advance(w, work, awake, kMinute).accepted);
    set_threads(1);
    EXPECT_GT(w.state.clock.shortened, 0);
    complete_points(w, work);
    complete_contacts(w.ranks, w.state);
    complete_cells(w.ranks, w.state);
    return hash_state(w.state);
  };
  const std::uint64_t alone = hash_after(Ranks::serial(), Sharing::kBalanced, 1);
  EXPECT_EQ(hash_after(Ranks::serial(), Sharing::kBalanced, 2), alone);
  for (const Sharing sharing : {Sharing::kBalanced, Sharing::kRandom})
    EXPECT_EQ(hash_after(Ranks::world(), sharing, 1), alone);
}

}  // namespace
}  // namespace acinus::coupling
