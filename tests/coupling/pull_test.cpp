/// Pulls over time on cells that are stepped.

#include "coupling/apparatus/pull/pull.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// One cell of either model, far apart.
World two_models() {
  World w = make_test_world({{Vec3(0, 0, 0), true}, {Vec3(100, 0, 0), false}}, 1, 42);
  w.params.motility.random = false;
  w.params.numerics.cg.tolerance = 1e-10;
  return w;
}

Vec3 shell(const World& w) { return dcm::cell_center(w.state.dcm, 0); }
Vec3 sphere(const World& w) { return cbm::center_of(w.state.cbm, 0); }

Pull rising(int cell) {
  Pull p;
  p.cell = cell;
  p.direction = Vec3::UnitY();
  p.force.entry = {{0, 0}, {10, 1}, {10, 0}};
  return p;
}

Apparatus pulled_by(std::vector<Pull> pull) {
  Pulls pulls;
  pulls.pull = std::move(pull);
  Apparatus all;
  all.add(std::move(pulls));
  return all;
}

// Motion without inertia sums the force: a ramp to 1 nN moves a cell as 0.5 nN does.
TEST(Pull, ARampMovesACellAsItsMeanDoes) {
  World ramp = two_models(), mean = two_models();
  ramp.params.apparatus = pulled_by({rising(0), rising(1)});
  mean.state.dcm.pull[0] = Vec3(0, 0.5, 0);
  mean.state.cbm.pull.set(0, Vec3(0, 0.5, 0));
  Simulation a(ramp), b(mean);
  EXPECT_TRUE(a.run_until(20, {}).ok);
  EXPECT_TRUE(b.run_until(10, {}).ok);
  EXPECT_NEAR(shell(a.world()).y(), shell(b.world()).y(), 1e-8 * shell(b.world()).y());
  EXPECT_NEAR(sphere(a.world()).y(), sphere(b.world()).y(), 1e-8 * sphere(b.world()).y());
  EXPECT_GT(shell(b.world()).y(), 1e-3);
}

TEST(Pull, StepsEndWhereTheForceBends) {
  World w = two_models();
  w.params.numerics.max_step = 3;
  w.params.apparatus = pulled_by({rising(0)});
  Simulation s(w);
  bool met = false;
  Observer watch;
  watch.step = [&](const StepResult&) { met = met || std::abs(s.time() - 10) < 1e-12; };
  EXPECT_TRUE(s.run_until(20, watch).ok);
  EXPECT_TRUE(met);
}

// The force of a spring on a cell in friction decays, exp(-k t / friction); a stiff one is there
// within a step whatever its length, and follows its far end.
TEST(Pull, ASpringTakesTheCellWhereItsEndIs) {
  World w = two_models();
  Pull p;
  p.cell = 0;
  p.direction = Vec3(0, 3, 4) / 5;
  p.stiffness = 1e4;
  p.displacement.entry = {{0, 0}, {10, 2}, {20, 2}};
  w.params.apparatus = pulled_by({p});
  Simulation s(w);
  EXPECT_TRUE(s.run_until(20, {}).ok);
  EXPECT_NEAR(shell(s.world()).dot(p.direction), 2, 1e-3);
  EXPECT_NEAR((shell(s.world()) - 2 * p.direction).norm(), 0, 1e-3);
  EXPECT_EQ(sphere(s.world()), Vec3(100, 0, 0));
  EXPECT_NEAR(pull_force(p, 20, shell(s.world())), 0, 0.1);
}

TEST(Pull, OfACellThatIsGoneDoesNothing) {
  World w = two_models(), alone = w;
  Pull p = rising(7), q = rising(8);
  q.stiffness = 1;
  w.params.apparatus = pulled_by({p, q});
  Simulation a(w), b(alone);
  EXPECT_TRUE(a.run_until(10, {}).ok);
  EXPECT_TRUE(b.run_until(10, {}).ok);
  EXPECT_EQ(shell(a.world()), shell(b.world()));
  EXPECT_EQ(sphere(a.world()), sphere(b.world()));
}

}  // namespace
}  // namespace acinus::coupling
