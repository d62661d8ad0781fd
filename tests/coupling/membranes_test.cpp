/// Substances inside cells behind membranes: filling, amounts while cells move and divide,
/// exchange.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.hpp"
#include "coupling/simulation.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/insides.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

constexpr double kPermeability = 0.02;

/// Adds a substance that passes the membranes of cells in a box of 200 um.
Substance& add_drug(World& w, double concentration) {
  SubstanceParams& p = w.params.substances;
  p.grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, 5);
  Substance s;
  s.name = "drug";
  s.medium.diffusion = 1000;
  s.exchange.resize(w.params.dcm.size());
  s.initial = concentration;
  s.outside_cells = true;
  s.permeability = kPermeability;
  p.substance = {s};
  begin_substances(p, w.state);
  return p.substance[0];
}

void advance_fields(World& w, double step) {
  SubstanceWorkspace work;
  Timings timings;
  advance_substances(w, step, work, timings);
}

TEST(Membranes, CellsOfBothModelsFillAtTheRateOfAreaOverVolume) {
  for (const bool deformable : {true, false}) {
    World w = make_test_world({{Vec3(101, 99, 102), deformable}}, 60);
    Substance& s = add_drug(w, 0);
    begin_open_spaces(w);
    s.medium.face.fill({substances::FaceKind::kFixed, 1, 0});
    w.state.substance[0].concentration.assign(w.params.substances.grid.n_voxel(), 1);
    constexpr int kStepsOfFilling = 100;
    for (int k = 0; k < kStepsOfFilling; ++k) advance_fields(w, 1);
    const Cell cell = list_cells(w.state)[0];
    double volume = 0;
    for (const double part : w.state.substance[0].inside.volume) volume += part;
    const double rate = -std::log(1 - cell_concentrations(w)[0][cell.index]) / kStepsOfFilling,
                 exact = kPermeability * area_of(w.state, cell) / volume;
    const auto [low, high] = std::ranges::minmax(w.state.substance[0].inside.concentration);
    std::printf("inside %.4f to %.4f\n", low, high);
    EXPECT_LT(high - low, 0.01);
    std::printf("%s: %+.2f %%\n", deformable ? "deformable" : "sphere", 100 * (rate / exact - 1));
    EXPECT_NEAR(rate, exact, 0.02 * exact);
    EXPECT_NEAR(volume, sphere_volume(12), 0.03 * sphere_volume(12));
  }
}

TEST(Membranes, AmountsStayWhileCellsMove) {
  for (const bool deformable : {true, false}) {
    // Two cells that overlap push each other apart.
    World w = make_test_world({{Vec3(95, 100, 100), deformable}, {Vec3(109, 101, 99), false}}, 60);
    Substance& s = add_drug(w, 5);
    CellExchange e;
    e.secretion = 0.05;
    e.uptake = 0.02;
    s.exchange.assign(w.params.dcm.size(), e);
    s.medium.decay = 1e-4;
    begin_open_spaces(w);
    const double before = amount_of(w.params.substances, w.state.substance[0]);
    Simulation simulation(std::move(w));
    ASSERT_TRUE(simulation.run_until(600).ok);
    const World& now = simulation.world();
    const SubstanceState& field = now.state.substance[0];
    EXPECT_NEAR(amount_of(now.params.substances, field) - before, field.secreted - field.decayed,
                1e-12 * before);
    EXPECT_GT(std::ranges::min(field.inside.concentration), 0);
    // Cells secrete up to a balance inside, c = 2.5, from which the space around them is far.
    for (const Cell& c : list_cells(now.state))
      EXPECT_LT(cell_concentrations(now)[0][c.index], 0.9 * 5);
  }
}

TEST(Membranes, CellsExchangeWhatTheyHold) {
  World w = make_test_world({{Vec3(100, 100, 100), false}}, 60);
  Substance& s = add_drug(w, 5);
  s.permeability = 1e-9;
  CellExchange e;
  e.uptake = 0.01;
  s.exchange.assign(w.params.dcm.size(), e);
  begin_open_spaces(w);
  const std::size_t cell = cell_index(w.state, 0);
  EXPECT_NEAR(cell_exchange_rates(w)[0][cell], -0.01 * 5 * sphere_volume(12),
              0.02 * 0.05 * sphere_volume(12));
  advance_fields(w, 100);
  EXPECT_NEAR(cell_concentrations(w)[0][cell], 5 / (1 + 0.01 * 100), 1e-4);
  const std::vector<double>& around = w.state.substance[0].concentration;
  EXPECT_NEAR(around[0], 5, 1e-6);
}

TEST(Membranes, WhatCellsHeldFollowsThem) {
  World w = make_test_world({{Vec3(60, 100, 100), false}, {Vec3(140, 100, 100), false}}, 60);
  add_drug(w, 0);
  begin_open_spaces(w);
  const SubstanceParams& p = w.params.substances;
  SubstanceState& field = w.state.substance[0];
  const std::int64_t first = field.inside.cell.front();
  for (std::size_t k = 0; k < field.inside.cell.size(); ++k)
    field.inside.concentration[k] = field.inside.cell[k] == first ? 3 : 0;
  const double before = amount_of(p, field);
  w.params.substances.substance[0].permeability = 1e-12;
  // It moves by a voxel and a half, and keeps what it holds.
  store_point(w.state.cbm.position.data(), cbm::cell_address(0, 0), Vec3(67.5, 100, 100));
  advance_fields(w, 60);
  EXPECT_NEAR(amount_of(p, field), before, 1e-12 * before);
  EXPECT_NEAR(cell_concentrations(w)[0][cell_index(w.state, 0)], 3, 0.1);
  EXPECT_NEAR(cell_concentrations(w)[0][cell_index(w.state, 1)], 0, 1e-6);
  // A cell of an unknown lineage has nothing; what the one before it held is around it now.
  w.state.cbm.lineage[0] = 77;
  advance_fields(w, 60);
  EXPECT_NEAR(amount_of(p, field), before, 1e-12 * before);
  EXPECT_NEAR(cell_concentrations(w)[0][cell_index(w.state, 0)], 0, 1e-6);
}

}  // namespace
}  // namespace acinus::coupling
