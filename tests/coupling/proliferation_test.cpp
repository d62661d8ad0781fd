/// Entry of cells into the cycle: layers, rates, windows, the number wanted; crowding.

#include "coupling/life/proliferation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "coupling/life/cell_cycle.hpp"
#include "coupling/life/density.hpp"
#include "coupling/subworld/population.hpp"
#include "tests/coupling/lives.hpp"

namespace acinus::coupling {
namespace {

/// Spheres in a row away from the vein axis, one per layer, 150 um and every 24 um on; `copies`
/// such rows far from each other along the axis.
World make_layers(int n_layer, int copies, const Proliferation& p) {
  std::vector<TestCell> cells;
  for (int c = 0; c < copies; ++c)
    for (int k = 0; k < n_layer; ++k)
      cells.push_back({Vec3(150.5 + 24 * k, 0, 200.0 * c + 1), false});
  World w = make_living_world(cells);
  w.params.life.proliferation = p;
  begin_life(w);
  return w;
}

int count_growing(const World& w) {
  int n = 0;
  for_each_cell(w.state,
                [&](const Cell& c) { n += w.state.cycle[c.index].fate == Fate::kGrow ? 1 : 0; });
  return n;
}

TEST(Proliferation, LayersAreCountedFromTheEdge) {
  EXPECT_EQ(layer_of(140, 150, 24), 1) << "ahead of the edge";
  EXPECT_EQ(layer_of(150, 150, 24), 1);
  EXPECT_EQ(layer_of(173.9, 150, 24), 1);
  EXPECT_EQ(layer_of(174, 150, 24), 2);
}

TEST(Proliferation, EdgeIsTheMeanOfTheSlicesOrThatOfTheStart) {
  Proliferation p;
  World w = make_layers(3, 2, p);
  store_point(w.state.cbm.position.data(), cbm::cell_address(0, 0), Vec3(0, 100.5, 1));
  EXPECT_NEAR(lesion_edge(w), 125.5, 1e-12);
  w.params.life.proliferation->edge_at_start = true;
  w.params.life.proliferation->start_edge = 150;
  EXPECT_EQ(lesion_edge(w), 150);
}

TEST(Proliferation, NobodyGrowsUntilItEntersTheCycle) {
  World w = make_layers(3, 1, {});
  EXPECT_EQ(count_growing(w), 0);
  EXPECT_TRUE(look(w, 3 * kDay).events.empty());
  for_each_cell(w.state, [&](const Cell& c) {
    EXPECT_NEAR(volume_of(w.state, c).at(3 * kDay), kBirthVolume, 1e-9 * kBirthVolume);
  });
  EXPECT_EQ(time_to_event(w), 600) << "the grid of life is kept all the same";
}

TEST(Proliferation, EntersWithTheRateOfItsLayerWithinTheWindow) {
  constexpr double kHour = 3600;
  Proliferation p;
  p.rate = {{1, 1, 0.2 / kHour, 0, 10 * kHour}, {2, 3, 0.02 / kHour, 0, 10 * kHour}};
  World w = make_layers(4, 250, p);
  w.params.life.type[0].time = 1000 * kHour;  // no cell divides meanwhile
  begin_life(w);
  for (double t = 600; t <= 20 * kHour; t += 600) look(w, t);
  std::array<double, 4> share{};
  for_each_cell(w.state, [&](const Cell& c) {
    if (w.state.cycle[c.index].fate == Fate::kGrow) share[lineage_of(w.state, c) % 4] += 1.0 / 250;
  });
  std::printf("shares by layer: %.3f %.3f %.3f %.3f\n", share[0], share[1], share[2], share[3]);
  // 1 - exp(-rate * window) (the draw at t = 0 is not in the window of 59 draws: 1/60 of it less);
  // standard error sqrt(p q / 250) = 0.022 and 0.024.
  EXPECT_NEAR(share[0], 1 - std::exp(-2 * 59.0 / 60), 4 * 0.022);
  EXPECT_NEAR(share[1], 1 - std::exp(-0.2 * 59.0 / 60), 4 * 0.024);
  EXPECT_NEAR(share[2], 1 - std::exp(-0.2 * 59.0 / 60), 4 * 0.024);
  EXPECT_EQ(share[3], 0);
}

TEST(Proliferation, StopsAtTheNumberWanted) {
  Proliferation p;
  p.rate = {{1, 9, 1, 0}};  // at once
  p.cells = 14;
  World w = make_layers(5, 2, p);
  look(w, 600);
  EXPECT_EQ(count_growing(w), 4);
  for (double t = 1200; t <= 3 * kDay; t += 600) look(w, t);
  EXPECT_EQ(count_cells(w.state), 14);
  EXPECT_EQ(w.state.divisions, 4);
  EXPECT_EQ(count_growing(w), 0) << "daughters rest";
}

TEST(Proliferation, DaughtersMayEnterAgain) {
  Proliferation p;
  p.rate = {{1, 9, 1, 0}};
  p.cells = 4;
  World w = make_layers(1, 1, p);
  for (double t = 600; t <= 4 * kDay; t += 600) look(w, t);
  EXPECT_EQ(count_cells(w.state), 4);
}

TEST(Proliferation, DoesNotDependOnTheOrderOfCells) {
  Proliferation p;
  p.rate = {{1, 9, 0.1 / 3600, 0}};
  World a = make_layers(4, 10, p);
  World b = a;
  std::vector<SelectedCell<State>> members = list_cbm(a.state);
  std::ranges::reverse(members);
  b.state = compose({}, members, a.state);
  for (double t = 600; t <= 7200; t += 600) look(a, t), look(b, t);
  const auto ia = index_cells(a.state), ib = index_cells(b.state);
  EXPECT_GT(count_growing(a), 2);
  for (const auto& [id, c] : ia)
    EXPECT_EQ(a.state.cycle[c.index].fate, b.state.cycle[ib.at(id).index].fate) << id;
}

TEST(Density, CountsCellsAndTheirImagesInMirrorPlanes) {
  World w = make_living_world({{Vec3(0, 0, 10), false}, {Vec3(30, 0, 10), false}});
  const double one = 1 / (4.0 / 3 * kPi * std::pow(kDensityReach, 3));
  EXPECT_NEAR(local_densities(w)[0], 2 * one, 1e-12 * one);
  contact::Plane floor;
  floor.material.mirror = true;
  w.params.boundary.planes = {floor};
  EXPECT_NEAR(local_densities(w)[0], 4 * one, 1e-12 * one);
  contact::Plane side;  // 40 um from the first cell: 80 um to its own image, the other's is nearer
  side.point = Vec3(40, 0, 0);
  side.normal = -Vec3::UnitX();
  side.material.mirror = true;
  w.params.boundary.planes.push_back(side);
  EXPECT_NEAR(local_densities(w)[0], 4 * one, 1e-12 * one) << "image at 50 um is out of reach";
  EXPECT_NEAR(local_densities(w)[1], 6 * one, 1e-12 * one) << "its own at 20 um, twice";
  w.params.boundary.planes[0].material.mirror = false;
  EXPECT_NEAR(local_densities(w)[1], 3 * one, 1e-12 * one);
}

TEST(Density, SlowsGrowthAndEntryDown) {
  const Inhibition by{InhibitedBy::kDensity, 1e-5, 4};
  EXPECT_EQ(growth_factor(by, {0, 1, 1e-5}), 0.5);
  EXPECT_EQ(growth_factor(by, {0, 1, 0}), 1);
  Proliferation p;
  p.rate = {{1, 9, 1, 0}};
  World w = make_layers(3, 1, p);
  w.params.life.type[0].inhibition = {InhibitedBy::kDensity, 1e-9, 8};
  look(w, 600);
  EXPECT_EQ(count_growing(w), 0);
}

}  // namespace
}  // namespace acinus::coupling
