/// Growth, rules and death.

#include "coupling/life/life.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/life/cell_cycle.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/workspace_size.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/lives.hpp"
#include "tests/messages.hpp"

namespace acinus::coupling {
namespace {

using Ids = std::vector<std::int64_t>;

constexpr double kRoundOff = 1e-13;  // a few operations, relative

double volume_at(World& w, std::int64_t id, double time) {
  return volume_of(w.state, index_cells(w.state).at(id)).at(time);
}
/// Spheres 50 um apart along x, far from each other.
World make_row(int n) {
  std::vector<TestCell> cells;
  for (int k = 0; k < n; ++k) cells.push_back({Vec3(50.0 * k, 0, 0), false});
  return make_living_world(cells);
}

// ---- growth -----------------------------------------------------------------------------------

TEST(Growth, StartsAnywhereInTheCycleWhenAsked) {
  CycleParams p = cycle_params();
  p.random_start = true;
  double sum = 0;
  for (int k = 0; k < 1000; ++k) {
    const double age = draw_start_age(p, 7, k);
    EXPECT_TRUE(age >= 0 && age < 1);
    sum += age;
  }
  EXPECT_NEAR(sum / 1000, 0.5, 4 / std::sqrt(12 * 1000.0));
  EXPECT_EQ(draw_start_age(cycle_params(), 7, 3), 0);
  World w = make_row(1);
  w.params.life.type[0].random_start = true;
  begin_life(w);
  const Cycle& c = w.state.cycle[0];
  EXPECT_NEAR(c.birth_volume * (1 + draw_start_age(p, w.params.life.seed, 0)), kBirthVolume,
              kRoundOff * kBirthVolume);
  EXPECT_NEAR(volume_at(w, 0, 2 * kDay), 2 * c.birth_volume, kRoundOff * kBirthVolume);
}

/// One shell that has grown for an hour.
struct Grown {
  World world;
  double volume = 0, pressure = 0, tension = 0;  ///< of the mesh um^3, cytosol kPa, largest nN/um
  double mean_tension = 0;
};
Grown grow_alone(double viscosity, int n_node, double step = 60) {
  Grown g;
  g.world = make_living_world({{Vec3(1, 2, 3)}}, n_node, step);
  World& w = g.world;
  w.params.dcm[0].viscosity = viscosity;
  w.params.life.type[0].spread = 0;
  w.params.numerics.adaptive = false;
  w.params.numerics.cg = {1e-12, 20000};
  begin_life(w);
  SizedWorkspace work(w);
  for (double t = 0; t < 3600; t += step) EXPECT_TRUE(take_step(w, work, step).accepted);
  observe(w, work);
  const CellMeasure m = measure_cells(w, work).at(0);
  g.volume = m.volume;
  g.pressure = m.cytosol_pressure;
  for (double t : measure_nodes(w, work).tension) {
    g.tension = std::max(g.tension, std::abs(t));
    g.mean_tension += t / n_node;
  }
  return g;
}

TEST(Growth, OfALoneShellInLiquidIsFree) {
  const Grown g = grow_alone(1e-6, 42);  // water, 1e-3 Pa s
  const dcm::Params& p = g.world.params.dcm[0];
  std::printf("an hour in liquid: cytosol %.1e K_V, tension %.1e k_s\n",
              g.pressure / p.bulk_modulus, g.tension / p.spring_stiffness);
  EXPECT_NEAR(g.volume, kBirthVolume * (1 + 1.0 / 24), 1e-6 * kBirthVolume);
  EXPECT_LE(std::abs(g.pressure), 1e-6 * p.bulk_modulus);
  EXPECT_LE(g.tension, 1e-6 * p.spring_stiffness);
}

TEST(Growth, InAMatrixPushesItAway) {
  const Grown g = grow_alone(0, 162, 10);
  const dcm::Params& p = g.world.params.dcm[0];
  const double r = std::cbrt(g.volume / (4.0 / 3 * kPi)),
               speed = kBirthVolume / kDay / (4 * kPi * r * r), push = p.medium_friction * speed;
  // All nodes move along their radius: p dV/dt = dissipation in the matrix and within the cortex +
  // (2 T / R) dV/dt.
  const geometry::Topology& t = geometry::shared_icosphere(162);
  double outer = 0, inner = 0;
  for (std::size_t i = 0; i < t.rest.size(); ++i)
    outer += push * t.rest_node_area[i] * t.rest[i].squaredNorm() / (4 * kPi);
  for (double l : t.rest_length) inner += p.nodal_friction * speed * l * l / (4 * kPi * r * r);
  const double tension = 2 * g.mean_tension / r;
  std::printf(
      "an hour in a matrix: cytosol %.3e kPa, gamma dR/dt %.3e kPa (mesh %.3e, cortex %.1e, "
      "2 T / R %.1e kPa)\n",
      g.pressure, push, outer, inner, tension);
  EXPECT_NEAR(g.pressure, push, 0.05 * push);
  // A step h leaves K_V (dR/R)^2 with dR/R = h / (3 days): 4e-9 kPa, a thousandth of the push.
  EXPECT_NEAR(g.pressure, outer + inner + tension, 0.005 * push);
}

// ---- rules ------------------------------------------------------------------------------------

TEST(Rules, DieInTheirRegionAndTimeOnly) {
  World w = make_row(10);
  LifeRule rule;
  rule.die = true;
  rule.inside = [](const Vec3& x) { return x.x() > 275; };  // cells 6 to 9
  rule.from = 1200;
  rule.until = 2400;
  LifeRule late = rule;
  late.inside = {};
  late.from = 2400.5;
  late.until = 2999.5;  // between two looks
  w.params.life.rule = {rule, late};
  begin_life(w);
  EXPECT_EQ(time_to_event(w), 600);
  EXPECT_TRUE(look(w, 600).events.empty());
  EXPECT_TRUE(look(w, 1199).events.empty());
  const LifeReport report = look(w, 1200);
  EXPECT_EQ(count_events(report, EventKind::kDeath), 4);
  EXPECT_EQ(lineages(w.state), (Ids{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(w.state.deaths, 4);
  store_point(w.state.cbm.position.data(), cbm::cell_address(0, 0), Vec3(400, 0, 0));
  EXPECT_EQ(look(w, 1200).events.size(), 0u) << "one look per time of the grid";
  EXPECT_EQ(look(w, 1800).events.size(), 1u) << "moved into the region";
  store_point(w.state.cbm.position.data(), cbm::cell_address(0, 0), Vec3(400, 0, 0));
  EXPECT_TRUE(look(w, 2400).events.empty()) << "over";
  EXPECT_TRUE(look(w, 3000).events.empty());
  EXPECT_EQ(w.state.cbm.n_cell(), 5u);
}

TEST(Rules, RestStopsGrowthForItsTime) {
  World w = make_row(2);
  LifeRule rule;
  rule.cells = {1};
  rule.from = 1200;
  rule.until = 2400;
  w.params.life.rule = {rule};
  w.params.life.type[0].spread = 0;
  begin_life(w);
  for (double time = 600; time <= 6000; time += 600) look(w, time);
  const double rate = kBirthVolume / kDay;
  EXPECT_NEAR(volume_at(w, 0, 6000), kBirthVolume + 6000 * rate, 1e-12 * kBirthVolume);
  EXPECT_NEAR(volume_at(w, 1, 6000), kBirthVolume + 4800 * rate, 1e-12 * kBirthVolume);
}

TEST(Rules, AreForDescendantsOfTheirCellsOrNot) {
  for (bool descendants : {true, false}) {
    World w = make_living_world({{Vec3::Zero(), false, Vec3::Zero(), kMotherRadius},
                                 {Vec3(90, 0, 0), false, Vec3::Zero(), kMotherRadius}});
    LifeRule rule;
    rule.die = true;
    rule.cells = {0};
    rule.descendants = descendants;
    rule.from = 300;
    w.params.life.rule = {rule};
    begin_with_mothers(w);
    look(w, 60);
    ASSERT_EQ(lineages(w.state), (Ids{2, 3, 4, 5}));
    look(w, 600);
    EXPECT_EQ(lineages(w.state), descendants ? (Ids{4, 5}) : (Ids{2, 3, 4, 5}));
  }
}

TEST(Rules, HoldForAShareOfTheCellsOnceAndForAll) {
  World w = make_row(1000);
  LifeRule rule;
  rule.die = true;
  rule.share = 0.3;
  w.params.life.rule = {rule};
  begin_life(w);
  const int died = count_events(look(w, 600), EventKind::kDeath);
  EXPECT_NEAR(died, 300, 4 * std::sqrt(1000 * 0.3 * 0.7));
  EXPECT_TRUE(look(w, 1200).events.empty()) << "drawn anew";
  w.params.life.rule.push_back(rule);
  EXPECT_NEAR(count_events(look(w, 1800), EventKind::kDeath), 0.3 * (1000 - died),
              4 * std::sqrt(1000 * 0.3 * 0.7))
      << "another rule draws for itself";
}

TEST(Rules, PressureSlowsGrowth) {
  World w =
      make_living_world({{Vec3::Zero(), false}, {Vec3(20, 0, 0), false}, {Vec3(90, 0, 0), false}});
  SizedWorkspace work(w);
  observe(w, work);
  const double pressure = measure_cells(w, work).at(0).pressure;
  ASSERT_GT(pressure, 1e-3);
  w.params.life.type[0].spread = 0;
  w.params.life.type[0].inhibition = {InhibitedBy::kPressure, 2 * pressure, 1};
  begin_life(w);
  w.state.clock.time = 600;
  observe(w, work);
  const double now = measure_cells(w, work).at(0).pressure;
  look(w, 600);
  const double rate = kBirthVolume / kDay;
  for (std::int64_t id : {0, 1})
    EXPECT_NEAR(volume_at(w, id, 4200) - volume_at(w, id, 600),
                3600 * rate / (1 + now / (2 * pressure)), 1e-9 * kBirthVolume);
  EXPECT_NEAR(volume_at(w, 2, 4200) - volume_at(w, 2, 600), 3600 * rate, 1e-9 * kBirthVolume);
}

// ---- death ------------------------------------------------------------------------------------

TEST(Death, RemovedCellsLeaveTheOthersAsTheyAre) {
  World w = make_living_world(checkered_cube());
  LifeRule rule;
  rule.die = true;
  rule.cells = {0, 3, 4};
  w.params.life.rule = {rule};
  begin_life(w);
  const World before = w;
  const LifeReport report = look(w, 0);
  EXPECT_EQ(count_events(report, EventKind::kDeath), 3);
  EXPECT_EQ(lineages(w.state), (Ids{1, 2, 5, 6, 7}));
  const auto old_index = index_cells(before.state);
  for (const auto& [id, c] : index_cells(w.state))
    EXPECT_EQ(center_of(w.state, c), center_of(before.state, old_index.at(id)));
}

TEST(Death, AMotherThatARuleTakesDoesNotDivide) {
  for (bool lysis : {false, true}) {
    World w = make_living_world({{Vec3::Zero(), false, Vec3::Zero(), kMotherRadius}});
    LifeRule rule;
    rule.die = true;
    w.params.life.rule = {rule};
    w.params.life.type[0].death.lysis = lysis;
    begin_with_mothers(w);
    const LifeReport report = look(w, 600);
    EXPECT_EQ(count_events(report, EventKind::kDivision), 0);
    EXPECT_EQ(lineages(w.state), lysis ? Ids{0} : Ids{});
  }
}

TEST(Death, ByLysisShrinksToTheFinalVolumeThenRemoves) {
  for (bool deformable : {true, false}) {
    World w =
        make_living_world({{Vec3::Zero(), deformable}, {Vec3(60, 0, 0), deformable}}, 42, 600);
    w.params.dcm.push_back(w.params.dcm[0]);
    w.params.dcm[1].bulk_modulus *= 0.5;
    w.params.cbm.push_back(w.params.cbm[0]);
    w.params.life.type.push_back({});
    w.params.life.type[0].death = {true, 6 * 3600, 0.2, 1};
    LifeRule rule;
    rule.die = true;
    rule.cells = {0};
    rule.from = 1200;
    w.params.life.rule = {rule};
    begin_life(w);
    SizedWorkspace work(w);
    double volume = 0;  // when it begins
    bool gone = false;
    while (w.state.clock.time < 8 * 3600 && !gone) {
      const StepResult step = take_step(w, work, time_to_event(w));
      ASSERT_TRUE(step.accepted) << step.cause;
      const LifeReport report = live(w, work);
      const double t = w.state.clock.time;
      const auto index = index_cells(w.state);
      gone = !index.contains(0);
      if (count_events(report, EventKind::kLysis) > 0) {
        EXPECT_EQ(t, 1200);
        volume = volume_at(w, 0, t);
        EXPECT_EQ(type_of(w.state, index.at(0)), 1);
        EXPECT_EQ(type_of(w.state, index.at(1)), 0);
      }
      if (volume == 0 || gone) continue;
      const double share = 1 - 0.8 * (t - 1200) / (6 * 3600);
      EXPECT_NEAR(volume_at(w, 0, t), share * volume, kRoundOff * volume);
      if (!deformable) continue;
      std::vector<Vec3> node;
      dcm::copy_nodes(w.state.dcm, index.at(0).at, node);
      // The medium resists with gamma dR/dt, far below a thousandth of K_V.
      EXPECT_NEAR(geometry::compute_volume(node, geometry::shared_icosphere(42).triangle),
                  share * volume, 1e-3 * volume);
    }
    EXPECT_TRUE(gone);
    EXPECT_NEAR(w.state.clock.time, 1200 + 6 * 3600, 600 + 1e-6) << "the step that passes the end";
    EXPECT_EQ(w.state.deaths, 1);
    EXPECT_EQ(lineages(w.state), Ids{1});
  }
}

/// Two touching cells die in the same moment: the world goes on without them.
TEST(Death, TakesTheDyingAloneWhenAStepFailsAtThem) {
  World w =
      make_living_world({{Vec3::Zero(), true}, {Vec3(30, 0, 0), true}, {Vec3(60, 0, 0), false}});
  begin_life(w);
  SizedWorkspace work(w);
  const std::int64_t all[] = {0, 1, 2};
  EXPECT_TRUE(remove_dying(w, work, all, "nobody dissolves").events.empty());
  for (std::int64_t id : {1, 2})
    w.state.cycle[index_cells(w.state).at(id).index].fate = Fate::kLyse;
  const std::int64_t named[] = {0, 1};
  const LifeReport report = remove_dying(w, work, named, "a face would turn over");
  ASSERT_EQ(report.events.size(), 2u);
  EXPECT_EQ(report.events[0].kind, EventKind::kDeathEarly);
  EXPECT_EQ(report.events[0].cells, Ids{1});
  EXPECT_CONTAINS(report.events[0].message, "a face would turn over");
  EXPECT_EQ(report.events[1].kind, EventKind::kDeath);
  EXPECT_EQ(report.events[1].cells, Ids{1});
  EXPECT_EQ(lineages(w.state), (Ids{0, 2}));
  EXPECT_EQ(w.state.deaths, 1);
  EXPECT_TRUE(take_step(w, work, 60).accepted);
}

TEST(Death, OfTheLastDeformableCellsLeavesNoContactsBehind) {
  for (const bool spheres_stay : {false, true}) {
    std::vector<TestCell> cells{{Vec3(0, 0, 0)}, {Vec3(23, 0, 0)}};
    if (spheres_stay) cells.push_back({Vec3(0, 60, 0), false});
    World w = make_living_world(cells);
    LifeRule rule;
    rule.die = true;
    rule.cells = {0, 1};
    rule.from = 600;
    w.params.life.rule = {rule};
    begin_life(w);
    SizedWorkspace work(w);
    while (w.state.clock.time < 1200) {
      const StepResult step = take_step(w, work, time_to_event(w));
      ASSERT_TRUE(step.accepted) << step.cause;
      live(w, work);
      const bool dead = w.state.clock.time >= 600;
      EXPECT_EQ(lineages(w.state).size(), cells.size() - (dead ? 2 : 0));
    }
    EXPECT_TRUE(work.dcm.lists.pair.empty());
    EXPECT_TRUE(work.contacts.surface().empty());
  }
}

}  // namespace
}  // namespace acinus::coupling
