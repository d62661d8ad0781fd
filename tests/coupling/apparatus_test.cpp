/// Devices in a list: what a world asks of it, all of them do.

#include "coupling/apparatus/apparatus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "coupling/simulation.hpp"
#include "coupling/subworld/subworld.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Acts in every way a device can, each so that the order of two of them shows.
struct Probe : Device {
  double change = kNever;
  double number = 0;
  std::size_t families = 0;
  bool at_rest = true;

  double next_change(double time) const override { return change > time ? change : kNever; }
  void set_params(double, std::span<dcm::Params> types) const override {
    for (dcm::Params& p : types) p.cortex_tension = 10 * p.cortex_tension + number;
  }
  void add_cell_forces(double time, const ForcedCells& cells) const override {
    for (Vec3& f : cells.dcm_force) f = 10 * f + number * Vec3::UnitX();
    for (Vec3& f : cells.cbm_force) f += time * Vec3::UnitY();
  }
  void add_loads(double, const LoadedCells& cells, std::span<solve::RankOne> own) const override {
    cells.system.external_force[0] = 10 * cells.system.external_force[0] + number;
    for (solve::RankOne& family : own) family.coefficient[0] += number;
  }
  std::size_t count_rank_one() const override { return families; }
  bool acts_at_rest() const override { return at_rest; }
};
struct OtherProbe final : Probe {};

Probe probe(double number, std::size_t families = 0) {
  Probe p;
  p.number = number;
  p.families = families;
  return p;
}

TEST(Apparatus, WithoutDevicesDoesNothing) {
  const Apparatus none;
  EXPECT_EQ(none.next_change(0), kNever);
  EXPECT_EQ(none.count_rank_one(), 0U);
  EXPECT_EQ(none.get<Probe>().number, 0);
}

TEST(Apparatus, ChangesWhenTheFirstOfItsDevicesDoes) {
  Apparatus all;
  for (const double change : {7.0, 3.0, 5.0}) {
    Probe p;
    p.change = change;
    all.add(p);
  }
  EXPECT_EQ(all.next_change(0), 3);
  EXPECT_EQ(all.next_change(3), 5);
  EXPECT_EQ(all.next_change(7), kNever);
}

TEST(Apparatus, ActsInTheOrderInWhichDevicesWereAdded) {
  Apparatus all;
  all.add(probe(1));
  all.add(probe(2));
  std::vector<dcm::Params> types(2);
  all.set_params(0, types);
  EXPECT_EQ(types[1].cortex_tension, 12);
  World w = make_test_world({{Vec3::Zero(), true}, {Vec3(50, 0, 0), false}}, 1, 42);
  std::vector<Vec3> shells(w.state.dcm.n_lane(), Vec3::Zero());
  std::vector<Vec3> spheres(w.state.cbm.n_cell(), Vec3::Zero());
  all.add_cell_forces(4, {w.state.dcm, w.state.cbm, shells, spheres});
  EXPECT_EQ(shells[0], Vec3(12, 0, 0));
  EXPECT_EQ(spheres[0], Vec3(0, 8, 0));
}

// Families stand behind those of the cells, in the order of the devices.
TEST(Apparatus, GivesEachDeviceTheFamiliesItAskedFor) {
  World w = make_test_world({{Vec3::Zero(), true}}, 1, 42);
  for (const auto& p : {probe(3, 2), probe(4), probe(5, 1)}) w.params.apparatus.add(p);
  SizedWorkspace work(w);
  const std::size_t own = work.system.rank_one.size() - 3;
  EXPECT_EQ(own, 2U) << "volume and area";
  solve::clear_loads(work.system);
  w.params.apparatus.add_loads(0, {w.state.dcm, work.lanes, work.system});
  std::vector<double> coefficient;
  for (const solve::RankOne& family : work.system.rank_one)
    coefficient.push_back(family.coefficient[0]);
  EXPECT_EQ(coefficient, (std::vector<double>{0, 0, 3, 3, 5}));
  EXPECT_EQ(work.system.external_force[0], 345);
}

TEST(Apparatus, FindsADeviceByItsKind) {
  Apparatus all;
  OtherProbe other;
  other.number = 9;
  all.add(other);
  EXPECT_EQ(all.get<OtherProbe>().number, 9);
  EXPECT_EQ(Apparatus().get<OtherProbe>().number, 0);
}

TEST(Apparatus, StepsEndWhereADeviceChanges) {
  World w = make_test_world({{Vec3::Zero(), true}}, 3, 42);
  w.params.motility.random = false;
  Probe p;
  p.change = 10;
  w.params.apparatus.add(p);
  Simulation s(w);
  bool met = false;
  Observer watch;
  watch.step = [&](const StepResult&) { met = met || std::abs(s.time() - 10) < 1e-12; };
  EXPECT_TRUE(s.run_until(11, watch).ok);
  EXPECT_TRUE(met);
}

// Division settles in such a world: what drives cells from place to place is not in it, the rest
// is.
TEST(Apparatus, AWorldAtRestHasNoDrives) {
  World w = make_test_world({{Vec3::Zero(), true}}, 1, 42);
  Probe drive = probe(1);
  drive.at_rest = false;
  w.params.apparatus.add(drive);
  w.params.apparatus.add(probe(2));
  Subworld sub;
  extract_at_rest(w, {{0}, {}}, {}, sub);
  std::vector<dcm::Params> types(1);
  sub.world.params.apparatus.set_params(0, types);
  EXPECT_EQ(types[0].cortex_tension, 2);
  w.params.apparatus.set_params(0, types);
  EXPECT_EQ(types[0].cortex_tension, 212) << "the large world keeps both";
}

}  // namespace
}  // namespace acinus::coupling
