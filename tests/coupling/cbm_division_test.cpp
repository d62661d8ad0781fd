/// Division of a sphere in a clump at rest: two daughters replace it, whose strength then rises.

#include "cbm/division.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "contact/jkr.hpp"
#include "core/numbers/random.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/pair_contacts.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kRamp = 0.1 * 86400;                ///< s
const double kDividingRadius = 12 * std::cbrt(2.0);  ///< um

/// Puts the daughters of one sphere into its own place and at the end of the arrays.
void divide_cell(World& world, std::size_t cell, const Vec3& direction) {
  const cbm::State old = world.state.cbm;
  const double now = world.state.clock.time;
  const cbm::DaughterSpheres d = cbm::divide({.center = cbm::center_of(old, cell),
                                              .radius = cbm::radii_at(old, now)[cell],
                                              .direction = direction,
                                              .time = now,
                                              .ramp_duration = kRamp});
  std::vector<cbm::NewCell> cells;
  for (std::size_t k = 0; k < old.n_cell(); ++k)
    cells.push_back({old.lineage[k], old.type[k], cbm::center_of(old, k),
                     cbm::radii_at(old, now)[k], old.young[k], old.pull[k], old.strength[k]});
  cells.push_back(cells[cell]);
  for (std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    cbm::NewCell& c = k == 0 ? cells[cell] : cells.back();
    c.lineage = static_cast<std::int64_t>(old.n_cell() + k);
    c.center = d.center[k];
    c.radius = d.radius;
    c.strength = d.strength;
  }
  world.state.cbm = cbm::make_state(cells);
  for (const auto& pair : old.touching)
    if (pair.first != static_cast<int>(cell) && pair.second != static_cast<int>(cell))
      world.state.cbm.touching.push_back(pair);
  world.state.last_move.clear();
}

World settled(World w) {
  w.params.numerics.cg.tolerance = 1e-6;
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, 10 * 86400));
  return w;
}

/// Lone cell, or a clump around a cell about to divide, at mechanical rest.
World resting_clump(int count, double capsule_radius = 0) {
  UniformStream random(7, Purpose::kJitter, 0);
  std::vector<TestCell> cells;
  for (const Vec3& x :
       make_clump({Lattice::kFcc, count, 24.5, 0.3}, [&] { return random.uniform(); }))
    cells.push_back({x, false});
  cells[0].radius = kDividingRadius;
  World w = make_test_world(cells, 600);
  if (capsule_radius > 0) {
    contact::Capsule shell;
    shell.radius = capsule_radius + 12;
    shell.min_radius = capsule_radius;
    shell.speed = 12.0 / 36000;
    w.params.boundary.capsules = {shell};
  }
  return settled(std::move(w));
}

std::vector<Vec3> forces_on_spheres(const World& w, const Workspace& work) {
  std::vector<Vec3> f;
  for (std::size_t k = 0; k < w.state.cbm.n_cell(); ++k) {
    const Address a = cbm::cell_address(cbm_first_row(w.state), k);
    f.push_back(load_point(work.system.force.data(), a) +
                load_point(work.system.external_force.data(), a));
  }
  return f;
}

double deepest_overlap(const World& w, const Workspace& work) {
  double overlap = 0;
  visit_sphere_pairs(w, work,
                     [&](const contact::Contact& c) { overlap = std::max(overlap, -c.gap); });
  return overlap;
}

double distance_of(const cbm::State& s, std::size_t a, std::size_t b) {
  return (cbm::center_of(s, a) - cbm::center_of(s, b)).norm();
}

/// Course of the day after a division.
struct Course {
  bool completed = false;
  int rejections = 0;
  double rest_speed = 0;  ///< um/min before the division
  double first_jump = 0;  ///< nN, of the force on a neighbour as the mother disappears
  double jump = 0;        ///< nN, largest change of the force on a cell in one later step
  double neighbour_move = 0, daughter_move = 0;  ///< um, largest in one step
  double ramp_overlap = 0, end_overlap = 0;      ///< um, deepest after the ramp and in the end
  double end_speed = 0;                          ///< um/min, largest in the last step
  double apart = 0;                              ///< um, daughters in the end
  World world;                                   ///< in the end
};

/// Divides cell 0 and goes on for a day. With the cap on displacements of real runs a step too far
/// is rejected.
Course follow(World w, const Vec3& direction, double step, double max_move = 0.3) {
  Course c;
  Workspace work;
  w.params.numerics.max_step = w.state.clock.step = step;
  w.params.numerics.max_move = max_move;
  size_workspace(w, work);
  c.rest_speed = take_step(w, work, step).max_move / step * 60;
  assemble(w, step, work);
  std::vector<Vec3> last = forces_on_spheres(w, work);
  last.push_back(Vec3::Zero());
  divide_cell(w, 0, direction);
  size_workspace(w, work);
  const double born = w.state.clock.time;
  const std::size_t n = w.state.cbm.n_cell();
  while (w.state.clock.time < born + 86400 - 1e-6) {
    const bool first = w.state.clock.time == born;
    const StepResult r = take_step(w, work, step);
    if (!r.accepted) return c;
    c.rejections += r.rejections;
    c.end_speed = r.max_move / r.step * 60;
    const std::vector<Vec3> force = forces_on_spheres(w, work);
    for (std::size_t k = 0; k < n; ++k) {
      const bool daughter = k == 0 || k + 1 == n;
      double& move = daughter ? c.daughter_move : c.neighbour_move;
      move = std::max(move, load_point(w.state.last_move.data(), cbm::cell_address(0, k)).norm());
      if (first && daughter) continue;
      double& jump = first ? c.first_jump : c.jump;
      jump = std::max(jump, (force[k] - last[k]).norm());
    }
    last = force;
    if (std::abs(w.state.clock.time - born - kRamp) < 0.5 * step)
      c.ramp_overlap = deepest_overlap(w, work);
  }
  c.end_overlap = deepest_overlap(w, work);
  c.apart = distance_of(w.state.cbm, 0, n - 1);
  c.world = std::move(w);
  c.completed = true;
  return c;
}

void print(const char* what, double step, const Course& c) {
  std::printf(
      "%s, dt %4.0f s: %d rejections; force on a neighbour jumps by %.3f nN at the division, on "
      "any "
      "cell by %.3f nN a step later; largest move of a neighbour %.3f, of a daughter %.3f um; "
      "deepest overlap %.2f um after the ramp, %.3f after a day; daughters %.2f um apart, %.0e "
      "um/min\n",
      what, step, c.rejections, c.first_jump, c.jump, c.neighbour_move, c.daughter_move,
      c.ramp_overlap, c.end_overlap, c.apart, c.end_speed);
}

contact::SpherePair equal_pair() {
  const double young = cbm::young_from_bulk(2.5, 0.47);
  return contact::reduced_pair({12, young, 0.47}, {12, young, 0.47}, 0.01);
}

TEST(CbmDivision, DaughtersAloneEndAtTheJkrRestDistance) {
  const double rest = 24 - contact::jkr_overlap(equal_pair(), 0);
  for (double step : {60.0, 120.0, 600.0, 1800.0}) {
    const World mother = resting_clump(1);
    const Course c = follow(mother, Vec3(1, 2, 2) / 3, step, step > 120 ? 0 : 0.3);
    ASSERT_TRUE(c.completed);
    print("two daughters", step, c);
    EXPECT_EQ(c.rejections, 0);
    EXPECT_NEAR(c.apart, rest, 1e-6);
    // The solver's tolerance is 1e-6 of moves that add up to 17 um.
    const cbm::State& s = c.world.state.cbm;
    EXPECT_LT(
        (0.5 * (cbm::center_of(s, 0) + cbm::center_of(s, 1)) - cbm::center_of(mother.state.cbm, 0))
            .norm(),
        2e-5);
    EXPECT_NEAR((cbm::center_of(s, 0) - cbm::center_of(s, 1)).dot(Vec3(1, 2, 2) / 3), c.apart, 1e-6)
        << "along the direction of the division";
  }
}

TEST(CbmDivision, InAClumpAtRestIsGentle) {
  const contact::SpherePair pair = equal_pair();
  const double closest = 2 * (kDividingRadius - 12);  // um, of the daughters' centres at birth
  const double birth_force = contact::jkr_force(pair, 24 - closest, false).force;
  const double rest_overlap = contact::jkr_overlap(pair, 0),
               pull_off = std::abs(contact::jkr_special(pair).pull_off.force);
  for (int count : {13, 27}) {
    const World clump = resting_clump(count);
    for (const Vec3& direction : {Vec3(Vec3(1, 2, 2) / 3), Vec3(0, 0.6, -0.8), Vec3(1, 0, 0)}) {
      std::vector<double> neighbour_move;
      for (double step : {60.0, 120.0}) {
        const Course c = follow(clump, direction, step);
        ASSERT_TRUE(c.completed);
        print(count == 13 ? "13 cells" : "27 cells", step, c);
        EXPECT_LT(c.rest_speed, 1e-3);
        EXPECT_EQ(c.rejections, 0);
        // The mother exerted nothing, and no daughter is deeper in a neighbour than she was: what
        // they exert lies between pull-off and nothing.
        EXPECT_LT(c.first_jump, pull_off);
        // Later the force between the daughters changes most: the ramp adds this much in a step,
        // and their motion apart reduces it. A neighbour may detach meanwhile.
        EXPECT_LT(c.jump, step / kRamp * birth_force + pull_off);
        // A fiftieth of a radius in a minute; nothing moves a neighbour but a daughter.
        EXPECT_LT(c.neighbour_move, c.daughter_move);
        EXPECT_LT(c.daughter_move, 2 * 0.01 * 12 * step / 60);
        neighbour_move.push_back(c.neighbour_move);
        EXPECT_LT(c.ramp_overlap, 4 * rest_overlap);
        EXPECT_LT(c.end_overlap, 1.1 * rest_overlap);
        EXPECT_LT(c.end_speed, 1e-6);
      }
      EXPECT_LT(neighbour_move[0], 0.6 * neighbour_move[1]) << "a jump, whatever the step";
    }
  }
}

TEST(CbmDivision, LongStepsEndWhereShortOnesDo) {
  const World clump = resting_clump(13);
  const Course fine = follow(clump, Vec3(1, 2, 2) / 3, 60);
  for (double step : {300.0, 600.0, 1800.0}) {
    const Course c = follow(clump, Vec3(1, 2, 2) / 3, step, 0);
    ASSERT_TRUE(c.completed);
    print("13 cells", step, c);
    EXPECT_LT(c.end_speed, 1e-6);
    EXPECT_NEAR(c.apart, fine.apart, 1e-3);
    EXPECT_NEAR(c.end_overlap, fine.end_overlap, 1e-3);
  }
}

// Neighbours that press on the mother press on her daughters at once, but in other directions and
// on less of them; they must find their new place within the cap on displacements and come to rest.
TEST(CbmDivision, InACompressedClumpStaysWithinTheCap) {
  const World clump = resting_clump(13, 30);
  for (double step : {60.0, 120.0}) {
    const Course c = follow(clump, Vec3(1, 2, 2) / 3, step);
    ASSERT_TRUE(c.completed);
    print("13 cells in a capsule of 30 um", step, c);
    EXPECT_EQ(c.rejections, 0);
    EXPECT_GT(c.first_jump, 1) << "not compressed";
    EXPECT_LT(c.end_speed, 0.01);
    EXPECT_GT(c.apart, 12);
  }
}

TEST(CbmDivision, AcrossANarrowGapFindsItsBalance) {
  World narrow = make_test_world({{Vec3(0.1, 0, 0), false, Vec3::Zero(), kDividingRadius}}, 600);
  for (double side : {-1.0, 1.0}) {
    contact::Plane wall;
    wall.point = {0, 0, -9 * side};
    wall.normal = {0, 0, side};
    wall.material.mirror = true;
    narrow.params.boundary.planes.push_back(wall);
  }
  narrow = settled(std::move(narrow));
  for (double step : {60.0, 120.0, 1800.0})
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(Vec3(0.05, 0, 1).normalized())}) {
      const Course c = follow(narrow, direction, step, step > 120 ? 0 : 0.3);
      ASSERT_TRUE(c.completed);
      print(direction.x() == 0 ? "across a gap of 18 um" : "nearly across", step, c);
      EXPECT_EQ(c.rejections, 0);
      EXPECT_LT(c.end_speed, 1e-6);
      const cbm::State& s = c.world.state.cbm;
      EXPECT_LT(std::abs(cbm::center_of(s, 0).z()), 9);
      // 8.98 um: walls press as much as the daughters. Off the axis, they slip past each other.
      if (direction.x() == 0)
        EXPECT_NEAR(c.apart, 8.98, 0.01);
      else
        EXPECT_NEAR(c.apart, 24 - contact::jkr_overlap(equal_pair(), 0), 1e-3);
    }
}

TEST(SphereStrength, DoesNotWeakenTheInterfaceWithDeformableCells) {
  const auto look = [](double strength, Workspace& work) {
    World w = make_test_world({{Vec3::Zero(), true}, {Vec3(22.5, 2, 1), false}});
    w.params.cbm[0].correction = {{{4000, 4}}, {}, 0.2};
    w.state.cbm.strength.set(0, Ramp::constant(strength));
    size_workspace(w, work);
    observe(w, work);
    return w;
  };
  Workspace old, born;
  const World old_world = look(1, old), new_world = look(0, born);
  const InterfaceForce f = interface_forces(old_world, old).at(0),
                       g = interface_forces(new_world, born).at(0);
  EXPECT_GT(f.force.norm(), 0.1);
  EXPECT_EQ(g.force, f.force);
  EXPECT_EQ(g.area, f.area);
  EXPECT_GT(old.cbm.overlap_sum[0], 0);
  EXPECT_EQ(born.cbm.overlap_sum[0], old.cbm.overlap_sum[0]);
  EXPECT_EQ(born.cbm.contact_area[0], old.cbm.contact_area[0]);
  EXPECT_EQ(born.system.force, old.system.force);
}

TEST(SphereStrength, ScalesWhatIsMeasuredOfTwoYoungSpheres) {
  World w = make_test_world({{Vec3::Zero(), false}, {Vec3(22, 0, 0), false}});
  SizedWorkspace work(w);
  observe(w, work);
  const CellMeasure full = measure_cells(w, work)[0];
  w.state.cbm.strength.set(1, Ramp::constant(0.25));
  observe(w, work);
  EXPECT_EQ(measure_cells(w, work)[0].contact_force, full.contact_force) << "one cell is enough";
  w.state.cbm.strength.set(0, Ramp::constant(0.125));
  observe(w, work);
  const CellMeasure weak = measure_cells(w, work)[0];
  EXPECT_GT(full.contact_force, 0.1);
  EXPECT_DOUBLE_EQ(weak.contact_force, 0.25 * full.contact_force);
  EXPECT_DOUBLE_EQ(weak.pressure, 0.25 * full.pressure);
  EXPECT_DOUBLE_EQ(weak.contact_area, 0.25 * full.contact_area);
  EXPECT_EQ(weak.contacts, 1);
}

TEST(SphereStrength, IsPartOfTheHash) {
  World w = make_test_world({{Vec3::Zero(), false}});
  const std::uint64_t before = hash_state(w.state);
  w.state.cbm.strength.set(0, {0, 1, 10, 20});
  EXPECT_NE(hash_state(w.state), before);
}

}  // namespace
}  // namespace acinus::coupling
