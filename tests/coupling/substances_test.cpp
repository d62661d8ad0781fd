/// Cells in fields of substances: shares of both models, responses, guidance, the order of a step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.hpp"
#include "coupling/migration/migration.hpp"
#include "coupling/simulation.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/growing_box.hpp"
#include "coupling/substances/responses.hpp"
#include "coupling/substances/vessel_feed.hpp"
#include "substances/diffusion.hpp"
#include "substances/sample.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

/// Adds a substance in a box of 200 um, its concentration `low` at x = 0 and `high` at x = 200 um.
void add_ramp(World& w, double low, double high) {
  SubstanceParams& p = w.params.substances;
  p.grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, 10);
  Substance s;
  s.name = "signal";
  s.medium.diffusion = 100;
  s.medium.face[0] = {substances::FaceKind::kFixed, low, 0};
  s.medium.face[1] = {substances::FaceKind::kFixed, high, 0};
  s.exchange.resize(w.params.dcm.size());
  p.substance = {s};
  begin_substances(p, w.state);
  std::vector<double>& c = w.state.substance[0].concentration;
  for (std::size_t v = 0; v < c.size(); ++v)
    c[v] = low + (high - low) * (static_cast<double>(v % 20) + 0.5) / 20;
}

TEST(Substances, CellsOfBothModelsHaveTheirVolumeInVoxels) {
  World w = make_test_world({{Vec3(60, 100, 100), true}, {Vec3(140, 100, 100), false}});
  add_ramp(w, 1, 3);
  const substances::Shares shares = share_cells(w.params.substances, w.state);
  ASSERT_EQ(shares.n_body(), 2U);
  const std::vector<std::vector<double>> mean = cell_concentrations(w);
  std::size_t body = 0;
  for_each_cell(w.state, [&](const Cell& c) {
    double sum = 0;
    for (const substances::VoxelShare& s : shares.of(body)) sum += s.volume;
    const double volume = volume_of(w.state, c).at(0);
    EXPECT_NEAR(sum, volume, (c.deformable ? 0.05 : 1e-9) * volume);
    EXPECT_NEAR(mean[0][c.index], 1 + 2 * center_of(w.state, c).x() / 200, 0.01);
    ++body;
  });
}

TEST(Substances, HillFunctionsRiseAndFall) {
  SignalRule r;
  r.half_max = 2;
  r.power = 3;
  EXPECT_DOUBLE_EQ(signal_response(r, 2), 0.5);
  EXPECT_DOUBLE_EQ(signal_response(r, 4), 8.0 / 9);
  EXPECT_EQ(signal_response(r, -1e-9), 0);
  r.decreases = true;
  EXPECT_DOUBLE_EQ(signal_response(r, 4), 1.0 / 9);
  r.power = 1000;  // a threshold
  EXPECT_EQ(signal_response(r, 200), 0);
  EXPECT_EQ(signal_response(r, 1), 1);
}

TEST(Substances, RulesOfATypeActOnItsCellsInLysis) {
  SignalRule r;
  r.behaviour = Behaviour::kAdhesion;
  r.type = 0;
  EXPECT_TRUE(acts_on(r, Behaviour::kAdhesion, 0));
  EXPECT_FALSE(acts_on(r, Behaviour::kAdhesion, 2)) << "another type";
  r.lysing_type = 2;
  EXPECT_TRUE(acts_on(r, Behaviour::kAdhesion, 2));
  EXPECT_FALSE(acts_on(r, Behaviour::kAdhesion, 1));
  EXPECT_FALSE(acts_on(r, Behaviour::kMotility, 2));
}

TEST(Substances, GrowthFollowsTheSignal) {
  World w = make_living_world({{Vec3(40, 100, 100), false}, {Vec3(160, 100, 100), true}});
  add_ramp(w, 0, 10);
  SignalRule r;
  r.half_max = 5;
  r.power = 2;
  w.params.rules.rule = {r};
  begin_life(w);
  EXPECT_EQ(time_to_event(w), 600) << "the grid of life is kept";
  look(w, 600);
  for_each_cell(w.state, [&](const Cell& c) {
    const Cycle& cycle = w.state.cycle[c.index];
    const Ramp& volume = volume_of(w.state, c);
    const double rate = (volume.to - volume.from) / (volume.end - volume.start);
    const double at = cell_concentrations(w)[0][c.index];
    EXPECT_NEAR(rate, signal_response(r, at) * cycle.birth_volume / cycle.duration, 1e-12 * rate);
  });
}

TEST(Substances, CellsDieAtTheRateOfTheSignal) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 400; ++k)
    cells.push_back({Vec3(5 + k % 20 * 10, 5 + k / 20 * 10, 100), false});
  World w = make_living_world(cells);
  add_ramp(w, 4, 4);
  SignalRule r;
  r.behaviour = Behaviour::kDeath;
  r.half_max = 4;
  r.rate = 2.0 / 3600;
  w.params.rules.rule = {r};
  ASSERT_TRUE(has_life(w.params));
  begin_life(w);
  for (int k = 1; k <= 6; ++k) look(w, 600.0 * k);
  const double left = count_cells(w.state) / 400.0;
  std::printf("left after an hour: %.3f\n", left);
  // exp(-1 h * 0.5 * 2 / h); standard error sqrt(p q / 400).
  EXPECT_NEAR(left, std::exp(-1.0), 4 * 0.024);
}

TEST(Substances, ChemotaxisPointsUpTheGradient) {
  World w = make_test_world({{Vec3(60, 100, 100), true}, {Vec3(140, 100, 100), false}});
  add_ramp(w, 1, 3);
  SignalRule r;
  r.behaviour = Behaviour::kChemotaxis;
  r.half_max = 1e-6;
  r.of = 0;
  r.force = 0.5;
  w.params.rules.rule = {r};
  w.params.substances.leader_signal = 0;
  update_guidance(w.params, w.state);
  for_each_cell(w.state, [&](const Cell& c) {
    const double x = center_of(w.state, c).x(), here = 1 + 2 * x / 200;
    const double across = 2 * sphere_radius(volume_of(w.state, c).at(0)) * 2 / 200 / here;
    const double share = across / (across + r.sensitivity);
    const Guidance& g = w.state.guidance[c.index];
    EXPECT_LT((g.force - Vec3(0.5 * share, 0, 0)).norm(), 1e-3);
    EXPECT_LT((g.heading - Vec3(share, 0, 0)).norm(), 2e-3);
  });
  MediumFriction medium{std::vector<double>(w.state.dcm.n_lane(), 1.0),
                        RowVector<double>(w.state.cbm.n_cell(), 1.0)};
  const std::vector<std::uint8_t> leader(w.state.dcm.n_lane() + w.state.cbm.n_cell(), 1);
  w.params.motility.random = false;
  w.params.motility.leader_force = 2;
  CellForces forces;
  compute_cell_forces(w, w.state, 60, medium, leader, forces);
  const Guidance& of_sphere = w.state.guidance[cell_index(w.state, 0)];
  EXPECT_LT((forces.cbm[0] - of_sphere.force - 2 * of_sphere.heading).norm(), 1e-15);
}

TEST(Substances, FlatFieldsGuideNobody) {
  World w = make_test_world({{Vec3(60, 100, 100), false}});
  add_ramp(w, 0, 0);
  w.params.substances.leader_signal = 0;
  update_guidance(w.params, w.state);
  EXPECT_EQ(w.state.guidance[0].heading, Vec3(0, 0, 0));
}

TEST(Substances, SecretionAndUptakeRespond) {
  World w = make_test_world({{Vec3(60, 100, 100), true}, {Vec3(140, 100, 100), false}});
  add_ramp(w, 1, 3);
  SubstanceParams& p = w.params.substances;
  CellExchange e;
  e.secretion = 0.2;
  e.uptake_max = 0.4;
  e.half_max = 1;
  Substance drug;
  drug.name = "drug";
  drug.exchange.assign(w.params.dcm.size(), e);
  p.substance.push_back(drug);
  SubstanceState field;
  field.concentration.assign(p.grid.n_voxel(), 1.0);
  w.state.substance.push_back(field);
  const std::vector<std::vector<double>> before = cell_exchange_rates(w);
  SignalRule secretes, takes;
  secretes.behaviour = Behaviour::kSecretion;
  secretes.decreases = true;
  takes.behaviour = Behaviour::kUptake;
  for (SignalRule* r : {&secretes, &takes}) {
    r->half_max = 2;
    r->power = 3;
    r->of = 1;
  }
  w.params.rules.rule = {secretes, takes};
  const std::vector<std::vector<double>> signal = cell_concentrations(w),
                                         after = cell_exchange_rates(w);
  const substances::Shares shares = share_cells(p, w.state);
  std::size_t body = 0;
  double gained = 0;
  for_each_cell(w.state, [&](const Cell& c) {
    double volume = 0;
    for (const substances::VoxelShare& s : shares.of(body++)) volume += s.volume;
    const double falls = signal_response(secretes, signal[0][c.index]),
                 rises = signal_response(takes, signal[0][c.index]);
    EXPECT_NEAR(before[1][c.index], volume * (0.2 - 0.4 / 2), 1e-12 * volume);
    EXPECT_NEAR(after[1][c.index], volume * (0.2 * falls - 0.4 / 2 * rises), 1e-12 * volume);
    EXPECT_EQ(after[0][c.index], 0);  // of the signal itself
    gained += after[1][c.index];
  });
  EXPECT_GT(gained, 0);
  SubstanceWorkspace work;
  Timings timings;
  w.state.clock.phase = Phase::kRun;
  advance_substances(w, 1e-3, work, timings);
  EXPECT_NEAR(w.state.substance[1].secreted, 1e-3 * gained, 1e-3 * 1e-3 * gained);
}

TEST(Substances, FieldsAdvanceWithEveryStep) {
  World w = make_test_world({{Vec3(100, 100, 100), false}}, 60);
  add_ramp(w, 5, 5);
  CellExchange e;
  e.uptake = 0.1;
  w.params.substances.substance[0].exchange.assign(w.params.dcm.size(), e);
  const double before =
      substances::total_amount(w.params.substances.grid, w.state.substance[0].concentration);
  Simulation simulation(std::move(w));
  EXPECT_TRUE(simulation.run_until(300).ok);
  const World& now = simulation.world();
  const SubstanceState& field = now.state.substance[0];
  const double held = substances::total_amount(now.params.substances.grid, field.concentration);
  EXPECT_LT(field.secreted, 0);
  EXPECT_NEAR(held - before, field.secreted + field.entered, 1e-12 * before);
  EXPECT_LT(cell_concentrations(now)[0][cell_index(now.state, 0)], 4.9);
}

TEST(Substances, SurfacesTakeUpByTheirArea) {
  for (const bool deformable : {true, false}) {
    World w = make_test_world({{Vec3(100, 100, 100), deformable}});
    add_ramp(w, 5, 5);
    CellExchange e;
    e.secretion_per_area = 0.4;
    e.uptake_per_area = 0.1;
    w.params.substances.substance[0].exchange.assign(w.params.dcm.size(), e);
    const double area = 4 * kPi * 12 * 12;
    const std::size_t cell = deformable ? 0 : cell_index(w.state, 0);
    EXPECT_NEAR(cell_exchange_rates(w)[0][cell], area * (0.4 - 0.5), 0.06 * 0.1 * area);
  }
}

TEST(Substances, StepsEndWhereTheSupplyChanges) {
  World w = make_test_world({{Vec3(100, 100, 100), false}}, 60);
  add_ramp(w, 5, 5);
  w.params.substances.substance[0].course.entry = {{90, 1}, {90, 0}};
  std::vector<double> ends;
  Simulation simulation(std::move(w));
  EXPECT_TRUE(
      simulation
          .run_until(200, {.step = [&](const StepResult&) { ends.push_back(simulation.time()); }})
          .ok);
  EXPECT_NE(std::ranges::find(ends, 90.0), ends.end());
  EXPECT_LT(std::ranges::max(simulation.world().state.substance[0].concentration), 4);
}

TEST(Substances, CellsInLysisTakeUpNothing) {
  World w = make_living_world({{Vec3(100, 100, 100), false}});
  add_ramp(w, 5, 5);
  CellExchange e;
  e.uptake = 0.1;
  w.params.substances.substance[0].exchange.assign(w.params.dcm.size(), e);
  begin_life(w);
  w.state.cycle[cell_index(w.state, 0)].fate = Fate::kLyse;
  SubstanceWorkspace work;
  Timings timings;
  advance_substances(w, 60, work, timings);
  EXPECT_EQ(w.state.substance[0].secreted, 0);
}

TEST(Substances, VesselsFeedAlongTheirWalls) {
  const substances::VoxelGrid g = substances::make_grid({Vec3::Zero(), Vec3::Constant(100)}, 5);
  geometry::Network vessel;
  vessel.node = {Vec3(10, 50, 50), Vec3(90, 50, 50), Vec3(300, 50, 50)};
  vessel.segment = {{0, 1}, {1, 2}};
  vessel.radius = {{5, 5}, {5, 5}};
  substances::Medium m;
  m.gain.assign(g.n_voxel(), 0.0);
  m.loss.assign(g.n_voxel(), 0.0);
  add_vessel_feed(g, vessel, 2, 7, m.gain, m.loss);
  double gain = 0, loss = 0;
  for (std::size_t v = 0; v < g.n_voxel(); ++v) {
    gain += m.gain[v] * g.voxel_volume();
    loss += m.loss[v] * g.voxel_volume();
  }
  // The second vessel leaves the box after 10 um.
  EXPECT_NEAR(loss, 2 * 2 * kPi * 5 * 90, 0.01 * loss);
  EXPECT_NEAR(gain, 7 * loss, 1e-12 * gain);
}

/// Oxygen in a box, fixed at all faces but the lower one along z, and taken up by two cells.
World world_in_oxygen(const substances::VoxelGrid& grid) {
  World w = make_test_world({{Vec3(100, 100, 60), true}, {Vec3(150, 100, 60), false}});
  SubstanceParams& p = w.params.substances;
  p.grid = p.first_grid = grid;
  Substance s;
  s.name = "oxygen";
  s.initial = 38;
  s.medium.diffusion = 2000;
  s.medium.face.fill({substances::FaceKind::kFixed, 38, 0});
  s.medium.face[4] = {};
  s.exchange.resize(w.params.dcm.size());
  for (CellExchange& e : s.exchange) e.uptake_max = 50;
  p.substance = {s};
  begin_substances(p, w.state);
  return w;
}

TEST(GrowingBox, KeepsTheMarginAndTheAmounts) {
  const substances::VoxelGrid grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, 10);
  World w = world_in_oxygen(grid);
  SubstanceParams& p = w.params.substances;
  p.margin = 60;
  grow_fields(w, {1});
  EXPECT_EQ(p.grid.n, grid.n);  // a box that stays
  p.grows = true;
  grow_fields(w, {0.5});
  // The sphere ends 38 um before x = 200 um: 22 um are lacking, and faces grow by four voxels.
  EXPECT_EQ(w.state.substance[0].layers, (substances::Layers{0, 4, 0, 0, 0, 0}));
  EXPECT_EQ(p.grid.box().high, Vec3(240, 200, 200));
  EXPECT_EQ(p.grid.box().low, Vec3(0, 0, 0));
  EXPECT_DOUBLE_EQ(w.state.substance[0].entered, 40.0 * 200 * 200 * 19);
  EXPECT_DOUBLE_EQ(amount_of(p, w.state.substance[0]), 200.0 * 200 * (200 * 38 + 40 * 19));
  grow_fields(w, {1});
  EXPECT_EQ(p.grid.n[0], 24);  // the margin is there
  const substances::VoxelGrid grown = p.grid;
  p.grid = grid;
  place_fields(p, w.state);
  EXPECT_EQ(p.grid.n, grown.n);
  EXPECT_EQ(p.grid.low, grown.low);
}

TEST(GrowingBox, HasTheFieldOfAWideOne) {
  const substances::VoxelGrid grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, 10);
  World narrow = world_in_oxygen(grid),
        wide = world_in_oxygen(substances::extend_grid(grid, {4, 8, 4, 4, 0, 0}));
  SubstanceParams& p = narrow.params.substances;
  p.margin = 110;
  Timings timings;
  SubstanceWorkspace of_narrow, of_wide;
  advance_substances(narrow, 60, of_narrow, timings);  // sizes the solver
  EXPECT_EQ(p.grid.n, grid.n);
  p.grows = true;
  advance_substances(narrow, 1e9, of_narrow, timings);
  advance_substances(wide, 1e9, of_wide, timings);
  ASSERT_EQ(p.grid.n, wide.params.substances.grid.n);
  EXPECT_LT((p.grid.low - wide.params.substances.grid.low).norm(), 1e-9);
  const std::vector<double>&a = narrow.state.substance[0].concentration,
        &b = wide.state.substance[0].concentration;
  EXPECT_LT(*std::ranges::min_element(b), 37);
  for (std::size_t v = 0; v < b.size(); ++v) ASSERT_NEAR(a[v], b[v], 1e-3);
}

}  // namespace
}  // namespace acinus::coupling
