/// Signals of cells measured by hand, the responses to them, and their way through divisions.

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/measure/signals.hpp"
#include "coupling/simulation.hpp"
#include "coupling/substances/responses.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

constexpr double kSphereRadius = 12;

SignalRule signal_rule(Signal signal, double half_max, Behaviour behaviour = Behaviour::kGrowth) {
  SignalRule r;
  r.signal = signal;
  r.half_max = half_max;
  r.behaviour = behaviour;
  return r;
}

/// Three spheres in a row that overlap by 1 um without adhesion, two deformable cells in contact,
/// and one that touches nothing.
World make_two_groups() {
  World w = make_living_world({{Vec3(0, 0, 0), false},
                               {Vec3(23, 0, 0), false},
                               {Vec3(46, 0, 0), false},
                               {Vec3(0, 100, 0), true},
                               {Vec3(23, 100, 0), true},
                               {Vec3(0, 200, 0), true}});
  w.params.cbm[0].adhesion = 0;
  return w;
}

/// Values of a rule by lineage.
std::vector<double> measure_rule(World w, const SignalRule& r) {
  w.params.rules.rule = {r};
  SizedWorkspace work(w);
  refresh_signals(w, work);
  std::vector<double> value(count_cells(w.state));
  for_each_cell(w.state, [&](const Cell& c) {
    value[lineage_of(w.state, c)] = w.state.signal.value[0][c.index];
  });
  return value;
}

TEST(Signals, ContactsArePressureAreaAndNumberOfHertz) {
  const World w = make_two_groups();
  const double poisson = w.params.cbm[0].poisson, young = w.state.cbm.young[0];
  const double modulus = young / (2 * (1 - poisson * poisson));
  const double force = 4.0 / 3 * modulus * std::sqrt(kSphereRadius / 2);
  const double pressure = force * (kSphereRadius - 0.5) / (3 * kBirthVolume);
  const std::vector<double> p = measure_rule(w, signal_rule(Signal::kPressure, 1)),
                            area = measure_rule(w, signal_rule(Signal::kContactArea, 1)),
                            near = measure_rule(w, signal_rule(Signal::kNeighbours, 1));
  for (const int end : {0, 2}) {
    EXPECT_NEAR(p[end], pressure, 1e-12 * pressure);
    EXPECT_NEAR(area[end], kPi * kSphereRadius / 2, 1e-10);
  }
  EXPECT_NEAR(p[1], 2 * pressure, 1e-12 * pressure);
  EXPECT_NEAR(area[1], kPi * kSphereRadius, 1e-10);
  EXPECT_EQ(near, (std::vector<double>{1, 2, 1, 1, 1, 0}));
  const Observed o(w);
  for (const CellMeasure& m : measure_cells(o.world, o.work))
    EXPECT_NEAR(area[m.id], m.contact_area, 1e-12 * m.area) << m.id;
  EXPECT_GT(area[3], 0);
  EXPECT_EQ(area[5], 0);
}

TEST(Signals, VolumeIsThatOfTheMeshOrOfTheRadius) {
  const World w = make_two_groups();
  const std::vector<double> volume = measure_rule(w, signal_rule(Signal::kVolume, 1));
  EXPECT_NEAR(volume[0], kBirthVolume, 1e-9 * kBirthVolume);
  for_each_cell(w.state, [&](const Cell& c) {
    if (!c.deformable) return;
    std::vector<Vec3> node;
    dcm::copy_nodes(w.state.dcm, c.at, node);
    EXPECT_NEAR(volume[lineage_of(w.state, c)],
                geometry::compute_volume(node, w.state.dcm.group[c.at / kLanes].topology->triangle),
                1e-9);
  });
}

TEST(Signals, NeighboursCountByTypeAndWhileTheyLive) {
  World w = make_two_groups();
  w.params.cbm.push_back(w.params.cbm[0]);
  w.params.dcm.push_back(w.params.dcm[0]);
  w.params.life.type.push_back(w.params.life.type[0]);
  w.state.cbm.type = PagedValues(std::vector<int>{0, 0, 1});
  SignalRule r = signal_rule(Signal::kNeighbours, 1);
  r.partner = 1;
  EXPECT_EQ(measure_rule(w, r), (std::vector<double>{0, 1, 0, 0, 0, 0}));
  r.partner = -1;
  begin_life(w);
  w.state.cycle[cell_index(w.state, 2)].fate = Fate::kLyse;
  EXPECT_EQ(measure_rule(w, r), (std::vector<double>{1, 1, 1, 1, 1, 0}));
  const std::vector<double> area = measure_rule(w, signal_rule(Signal::kContactArea, 1));
  EXPECT_NEAR(area[1], kPi * kSphereRadius / 2, 1e-10);
}

TEST(Signals, LayersAreCountedAroundTheAxis) {
  World w = make_test_world({{Vec3(150, 0, 0), false},
                             {Vec3(174, 0, 0), true},
                             {Vec3(198, 0, 0), false},
                             {Vec3(0, 120, 0), false}});
  w.params.rules.axis_point = Vec3(50, 0, 0);
  EXPECT_EQ(measure_rule(w, signal_rule(Signal::kLayer, 1)), (std::vector<double>{1, 2, 3, 1}));
}

TEST(Signals, AgeCountsFromBirth) {
  World w = make_two_groups();
  w.params.rules.rule = {signal_rule(Signal::kAge, 3600)};
  w.state.clock.time = 1000;
  const auto age = [&w](std::size_t index) {
    return own_signal(w.params.rules, 0, w.state, {false, index, cell_index(w.state, index)});
  };
  EXPECT_EQ(age(0), 1000) << "without a life since t = 0";
  begin_life(w);
  w.state.clock.time = 5000;
  w.state.cycle[cell_index(w.state, 1)].birth = 4500;
  EXPECT_EQ(age(0), 4000);
  EXPECT_EQ(age(1), 500);
}

TEST(Signals, GrowthAndDeathRespondWithoutSubstances) {
  World w = make_two_groups();
  SignalRule crowded = signal_rule(Signal::kNeighbours, 1.5), old = signal_rule(Signal::kAge, 600);
  crowded.decreases = true;
  crowded.power = 2;
  w.params.rules.rule = {crowded, old};
  begin_life(w);
  EXPECT_EQ(time_to_event(w), 600) << "the grid of life is kept";
  look(w, 600);
  const std::vector<double> near{1, 2, 1, 1, 1, 0};
  for_each_cell(w.state, [&](const Cell& c) {
    const double n = near[lineage_of(w.state, c)], x = n * n / (1.5 * 1.5);
    const Cycle& cycle = w.state.cycle[c.index];
    const Ramp& v = volume_of(w.state, c);
    const double free = cycle.birth_volume / cycle.duration;
    EXPECT_NEAR((v.to - v.from) / (v.end - v.start), free * (1 - x / (1 + x)) / 2, 1e-12 * free);
  });
  w.params.rules.rule = {signal_rule(Signal::kNeighbours, 1.5, Behaviour::kDeath)};
  w.params.rules.rule[0].power = 1000;
  w.params.rules.rule[0].rate = 1;
  w.state.signal = {};
  look(w, 1200);
  EXPECT_EQ(lineages(w.state), (std::vector<std::int64_t>{0, 2, 3, 4, 5})) << "the middle one";
}

TEST(Signals, MotilityAdhesionAndForcesRespond) {
  World w = make_two_groups();
  SignalRule moves = signal_rule(Signal::kVolume, kBirthVolume, Behaviour::kMotility);
  SignalRule sticks = signal_rule(Signal::kContactArea, kPi * kSphereRadius, Behaviour::kAdhesion);
  sticks.power = 1;
  w.params.rules.rule = {moves, sticks};
  SizedWorkspace work(w);
  refresh_signals(w, work);
  update_guidance(w.params, w.state);
  const auto at = [&w](std::size_t sphere) { return cell_index(w.state, sphere); };
  EXPECT_NEAR(w.state.guidance[at(0)].motility, 0.5, 1e-12);
  EXPECT_NEAR(w.state.adhesion[at(0)], 1.0 / 3, 1e-10);
  EXPECT_NEAR(w.state.adhesion[at(1)], 0.5, 1e-10);
  EXPECT_TRUE(w.state.guidance[at(0)].force.isZero(0));
}

TEST(Signals, AreMeasuredAtTheFirstStepAndOnTheGrid) {
  World w = make_two_groups();
  w.params.life.grid = 150;
  w.params.rules.rule = {signal_rule(Signal::kPressure, 1, Behaviour::kMotility)};
  std::vector<double> pressure;
  std::vector<std::int64_t> interval;
  Simulation simulation(std::move(w));
  const State& s = simulation.world().state;
  const auto keep = [&](const StepResult&) {
    pressure.push_back(s.signal.value[0][cell_index(s, 1)]);
    interval.push_back(s.signal.interval);
  };
  EXPECT_TRUE(simulation.run_until(300, {.step = keep}).ok);
  ASSERT_GE(pressure.size(), 4U);
  EXPECT_EQ(interval.front(), 0);
  EXPECT_EQ(interval.back(), 1);
  for (std::size_t k = 1; k < pressure.size(); ++k)
    EXPECT_EQ(pressure[k] == pressure[0], interval[k] == 0) << k;
}

TEST(Signals, DaughtersHaveThoseOfTheirMother) {
  World w = make_living_world({{Vec3(0, 0, 0), false, Vec3::Zero(), kMotherRadius},
                               {Vec3(29, 0, 0), false, Vec3::Zero(), kMotherRadius},
                               {Vec3(0, 90, 0), true, Vec3::Zero(), kMotherRadius}});
  w.params.rules.rule = {signal_rule(Signal::kNeighbours, 1, Behaviour::kAdhesion)};
  begin_with_mothers(w);
  {
    SizedWorkspace work(w);
    refresh_signals(w, work);
    update_guidance(w.params, w.state);
  }
  look(w, 60);
  ASSERT_EQ(w.state.divisions, 3);
  for_each_cell(w.state, [&](const Cell& c) {
    const bool alone = w.state.cycle[c.index].parent == 2;
    EXPECT_EQ(w.state.signal.value[0][c.index], alone ? 0 : 1);
    EXPECT_EQ(w.state.adhesion[c.index], alone ? 0 : 0.5);
  });
}

}  // namespace
}  // namespace acinus::coupling
