/// Substances kept out of cells and obstacles: amounts, exchange through surfaces, barriers.

#include "coupling/substances/open_spaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/sphere.hpp"
#include "coupling/simulation.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/vessel_feed.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

/// Adds a substance kept out of cells in a box of 200 um, with the same concentration everywhere.
Substance& add_substance(World& w, double concentration) {
  SubstanceParams& p = w.params.substances;
  p.grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, 5);
  Substance s;
  s.name = "signal";
  s.medium.diffusion = 100;
  s.exchange.resize(w.params.dcm.size());
  s.initial = concentration;
  s.outside_cells = true;
  p.substance = {s};
  begin_substances(p, w.state);
  return p.substance[0];
}

double open_volume(const World& w) {
  const std::vector<double>& open = w.state.substance[0].open;
  return w.params.substances.grid.voxel_volume() * std::accumulate(open.begin(), open.end(), 0.0);
}

TEST(OpenSpaces, AreWhatBothModelsLeave) {
  World w = make_test_world({{Vec3(60, 100, 100), true}, {Vec3(140, 100, 100), false}});
  add_substance(w, 3);
  begin_open_spaces(w);
  double cells = 0;
  for_each_cell(w.state, [&](const Cell& c) { cells += volume_of(w.state, c).at(0); });
  EXPECT_NEAR(open_volume(w), 8e6 - cells, 0.03 * cells);
  EXPECT_NEAR(amount_of(w.params.substances, w.state.substance[0]), 3 * open_volume(w), 1e-3);
}

TEST(OpenSpaces, AmountsStayWhileCellsMove) {
  for (const bool deformable : {true, false}) {
    // Two cells that overlap push each other apart.
    World w = make_test_world({{Vec3(95, 100, 100), deformable}, {Vec3(109, 101, 99), false}}, 60);
    Substance& s = add_substance(w, 5);
    CellExchange e;
    e.secretion = 0.05;
    e.uptake = 0.02;
    s.exchange.assign(w.params.dcm.size(), e);
    s.medium.decay = 1e-4;
    begin_open_spaces(w);
    const double before = amount_of(w.params.substances, w.state.substance[0]);
    const std::vector<double> open_before = w.state.substance[0].open;
    Simulation simulation(std::move(w));
    ASSERT_TRUE(simulation.run_until(600).ok);
    const World& now = simulation.world();
    const SubstanceState& field = now.state.substance[0];
    EXPECT_NE(field.open, open_before);
    EXPECT_NEAR(amount_of(now.params.substances, field) - before, field.secreted - field.decayed,
                1e-12 * before);
    EXPECT_GT(std::ranges::min(field.concentration), 0);
  }
}

TEST(OpenSpaces, CellsExchangeThroughTheirSurface) {
  for (const bool deformable : {true, false}) {
    World w = make_test_world({{Vec3(100, 100, 100), deformable}}, 60);
    Substance& s = add_substance(w, 5);
    CellExchange e;
    e.uptake = 0.01;
    s.exchange.assign(w.params.dcm.size(), e);
    begin_open_spaces(w);
    const substances::Shares shares = share_cells(w.params.substances, w.state, true);
    const double volume = sphere_volume(12);
    double sum = 0;
    for (const substances::VoxelShare& x : shares.share) {
      const auto v = static_cast<int>(x.voxel);
      const Vec3 center = w.params.substances.grid.center(v % 40, v / 40 % 40, v / 1600);
      EXPECT_NEAR((center - Vec3::Constant(100)).norm(), 12, 0.9 * 5);
      sum += x.volume;
    }
    EXPECT_NEAR(sum, volume, 0.05 * volume);
    const std::size_t cell = deformable ? 0 : cell_index(w.state, 0);
    EXPECT_NEAR(cell_concentrations(w)[0][cell], 5, 1e-12);
    EXPECT_NEAR(cell_exchange_rates(w)[0][cell], -0.01 * 5 * sum, 1e-9);
    SubstanceWorkspace work;
    Timings timings;
    advance_substances(w, 60, work, timings);
    EXPECT_LT(w.state.substance[0].secreted, -0.7 * 60 * 0.01 * 5 * volume);
    EXPECT_LT(cell_concentrations(w)[0][cell], 5);
  }
}

/// Steady uptake of a ball of 12 um that takes up all that reaches its surface, from the faces of a
/// box 100 um away, relative to the exact one of a sphere in a sphere.
double relative_uptake(double spacing) {
  World w = make_test_world({{Vec3(100, 100, 100), false}}, 60);
  Substance& s = add_substance(w, 5);
  w.params.substances.grid = substances::make_grid({Vec3::Zero(), Vec3::Constant(200)}, spacing);
  begin_substances(w.params.substances, w.state);
  s.medium.face.fill({substances::FaceKind::kFixed, 5, 0});
  CellExchange e;
  e.uptake = 1e4;
  s.exchange.assign(w.params.dcm.size(), e);
  begin_open_spaces(w);
  SubstanceWorkspace work;
  Timings timings;
  advance_substances(w, 1e9, work, timings);
  // A cube of edge 2 b holds the far field like a sphere of some 1.08 b.
  const double exact = 4 * kPi * 100 * 5 / (1 / 12.0 - 1 / 108.0);
  return -w.state.substance[0].secreted / 1e9 / exact;
}

TEST(OpenSpaces, UptakeAtASurfaceConvergesWithTheFirstOrder) {
  // Whole voxels at the surface are empty: the ball acts as if larger by about half of one.
  const double coarse = relative_uptake(5) - 1, fine = relative_uptake(2.5) - 1;
  std::printf("uptake %+.1f %%, %+.1f %%\n", 100 * coarse, 100 * fine);
  EXPECT_GT(fine, 0);
  EXPECT_LT(fine, 0.6 * coarse);
}

/// Wall with its cells at smaller x.
contact::Plane wall_at(double x) {
  contact::Plane plane;
  plane.point = Vec3(x, 0, 0);
  plane.normal = Vec3(-1, 0, 0);
  return plane;
}

TEST(OpenSpaces, WallsAndMeshesAreBarriers) {
  World w = make_test_world({{Vec3(40, 100, 100), false}}, 60);
  Substance& s = add_substance(w, 0);
  s.outside_obstacles = true;
  w.params.boundary.planes.push_back(wall_at(101.7));
  CellExchange e;
  e.secretion = 1;
  s.exchange.assign(w.params.dcm.size(), e);
  begin_open_spaces(w);
  EXPECT_NEAR(open_volume(w), 101.7 * 200 * 200 - sphere_volume(12), 2e-3 * 4e6);
  SubstanceWorkspace work;
  Timings timings;
  for (int k = 0; k < 10; ++k) advance_substances(w, 600, work, timings);
  const SubstanceState& field = w.state.substance[0];
  const substances::VoxelGrid& g = w.params.substances.grid;
  double beyond = 0;
  for (std::size_t v = 0; v < g.n_voxel(); ++v)
    if (v % 40 > 20) beyond += field.open[v] * field.concentration[v];
  EXPECT_EQ(beyond, 0);
  EXPECT_NEAR(amount_of(w.params.substances, field), field.secreted, 1e-12 * field.secreted);
  EXPECT_GT(field.secreted, 0);
}

TEST(OpenSpaces, WallsMoveFromTheEndOfAStartUpOn) {
  World w = make_test_world({{Vec3(40, 100, 100), false}}, 60);
  Substance& s = add_substance(w, 0);
  s.outside_obstacles = true;
  contact::Plane plane = wall_at(100);
  plane.speed = -10.0 / 3600;  // away from the cell
  plane.travel = 1000;
  w.params.boundary.planes.push_back(plane);
  w.state.clock.time = 5 * 3600;
  w.state.clock.origin = 4 * 3600;  // after four hours of start-up
  begin_open_spaces(w);
  EXPECT_NEAR(open_volume(w), 110.0 * 200 * 200 - sphere_volume(12), 2e-3 * 4e6);
}

TEST(OpenSpaces, VesselsFeedThroughTheirWallsFromOutside) {
  World w = make_test_world({{Vec3(40, 40, 40), false}}, 60);
  Substance& s = add_substance(w, 0);
  s.outside_cells = false;
  s.outside_obstacles = true;
  geometry::Network vessel;
  vessel.node = {Vec3(-50, 100, 100), Vec3(250, 100, 100)};
  vessel.segment = {{0, 1}};
  vessel.radius = {{14, 14}};
  contact::set_network(w.params.boundary.vessels, vessel);
  const substances::VoxelGrid& g = w.params.substances.grid;
  s.medium.wall_gain.assign(g.n_voxel(), 0.0);
  s.medium.wall_loss.assign(g.n_voxel(), 0.0);
  add_vessel_feed(g, vessel, 0.01, 7, s.medium.wall_gain, s.medium.wall_loss);
  begin_open_spaces(w);
  EXPECT_NEAR(open_volume(w), 8e6 - kPi * 14 * 14 * 200, 0.02 * kPi * 14 * 14 * 200);
  SubstanceWorkspace work;
  Timings timings;
  advance_substances(w, 1, work, timings);
  const SubstanceState& field = w.state.substance[0];
  // Hardly anything has come back after a second.
  const double expected = 0.01 * 7 * 2 * kPi * 14 * 200;
  EXPECT_NEAR(field.supplied, expected, 0.03 * expected);
  EXPECT_EQ(field.open[g.index(20, 20, 20)], 0);
  EXPECT_NEAR(amount_of(w.params.substances, field), field.supplied, 1e-12 * field.supplied);
}

TEST(OpenSpaces, NoSpaceLeftIsAnError) {
  World w = make_test_world({{Vec3(100, 100, 100), false}});
  add_substance(w, 5);
  w.params.substances.grid = substances::make_grid({Vec3::Constant(98), Vec3::Constant(102)}, 1);
  begin_substances(w.params.substances, w.state);
  EXPECT_THROW(begin_open_spaces(w), Error);
}

}  // namespace
}  // namespace acinus::coupling
