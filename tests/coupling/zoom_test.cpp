/// Cells that change their model while a scene runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/zoom/pair_forces.hpp"
#include "coupling/zoom/update.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/changing_cells.hpp"

namespace acinus::coupling {
namespace {

TEST(Zoom, NothingChangesWhereNoCellCrossesARegion) {
  World w = make_clump_world(2, 23, [](int k) { return k < 4; });
  SizedWorkspace work(w);
  run(w, work, 600);
  w.params.zoom.region = {ball(Vec3(0, 0, -500), 500)};  // the lower four
  const std::uint64_t before = hash_state(w.state);
  EXPECT_TRUE(update_zoom(w, work).changes.empty());
  EXPECT_EQ(hash_state(w.state), before);
}

TEST(Zoom, ACellKeepsWhatItIsBesideItsModel) {
  World w = make_clump_world(3, 22, [](int) { return false; });
  w.state.cbm.volume[13] = {7000, 7500, 0, 1e5};
  w.state.cbm.pull.set(13, Vec3(0.1, 0.2, 0.3));
  w.state.cycle.assign(27, Cycle{});
  w.state.cycle[13].duration = 123;
  SizedWorkspace work(w);
  run(w, work, 600);
  const Vec3 center = cbm::center_of(w.state.cbm, 13);
  w.params.zoom.region = {ball(center, 5)};
  const ZoomReport report = update_zoom(w, work);
  ASSERT_EQ(report.changes.size(), 1u);
  EXPECT_EQ(report.changes[0].kind, EventKind::kPromotion);
  EXPECT_EQ(report.changes[0].cell, 13);
  ASSERT_EQ(dcm::count_cells(w.state.dcm), 1);
  EXPECT_EQ(w.state.cbm.n_cell(), 26u);
  const auto lane = static_cast<std::size_t>(std::ranges::find(w.state.dcm.lineage, 13) -
                                             w.state.dcm.lineage.begin());
  const Ramp v = w.state.dcm.volume[lane];
  EXPECT_EQ(v.from, 7000);
  EXPECT_EQ(v.to, 7500);
  EXPECT_EQ(v.end, 1e5);
  EXPECT_EQ(w.state.dcm.pull[lane], Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(w.state.cycle[lane].duration, 123);
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, lane, node);
  EXPECT_LT(
      (geometry::compute_centroid(node, w.state.dcm.group[0].topology->triangle) - center).norm(),
      0.01 * 12);

  // And back.
  w.params.zoom.region = {ball(Vec3(500, 0, 0), 5)};
  run(w, work, 600);
  ASSERT_EQ(update_zoom(w, work).changes.size(), 1u);
  EXPECT_EQ(dcm::count_cells(w.state.dcm), 0);
  const auto at = static_cast<std::size_t>(std::ranges::find(w.state.cbm.lineage, 13) -
                                           w.state.cbm.lineage.begin());
  EXPECT_EQ(w.state.cbm.volume[at].from, 7000);
  EXPECT_EQ(w.state.cbm.volume[at].end, 1e5);
  EXPECT_EQ(w.state.cycle[at].duration, 123);
  EXPECT_EQ(w.state.cbm.pull[at], Vec3(0.1, 0.2, 0.3));
}

TEST(Zoom, AChangeJumpsNeitherPressureNorForces) {
  for (const double distance : {23.0, 22.0, 21.0}) {
    for (const bool to_mesh : {true, false}) {
      World w = make_clump_world(3, distance, [&](int k) { return k == 13 && !to_mesh; });
      SizedWorkspace work(w);
      run(w, work, 600);
      const Jump jump = change_one(w, work, 13);
      std::printf(
          "%g um, %s: pressure %.2f Pa, jump %.2f Pa; forces of neighbours %.2g of the "
          "mean; centre %.3f um; %.1f ms\n",
          distance, to_mesh ? "to a mesh" : "to a sphere", 1e3 * jump.before, 1e3 * jump.pressure,
          jump.force, jump.shift, jump.ms);
      EXPECT_LT(std::abs(jump.pressure), std::max(2e-3, 0.05 * std::abs(jump.before)));
      EXPECT_LT(jump.force, 0.1);
      EXPECT_LT(jump.shift, 0.12);
      const std::int64_t rejected = w.state.clock.rejected;
      run(w, work, 600);
      std::printf("   rejected %d steps\n", static_cast<int>(w.state.clock.rejected - rejected));
      EXPECT_LE(w.state.clock.rejected - rejected, 2);
    }
  }
}

// Neighbours alone decide the forces of a cell, and their order of summation is that of all cells.
TEST(Zoom, ContactsOfSomeCellsAreThoseInTheWholeWorldToTheBit) {
  for (const bool corrected : {false, true}) {
    World w = make_clump_world(4, 20.5, [](int k) { return k % 3 == 0; });
    if (corrected) w.params.cbm[0].correction = {{{5000, 4}}, {}, 0.19, 0};
    SizedWorkspace work(w);
    run(w, work, 600);
    w.params.zoom.region = {ball(center_of(w.state, *find_cell(w.state, 22)), 1)};
    w.params.zoom.margin = 1e9;
    ASSERT_EQ(update_zoom(w, work).changes.size(), 1u);  // leaves forces that fade
    ASSERT_FALSE(w.state.fading.empty());
    const std::set<std::int64_t> cells{21, 22};
    const CellContacts found = evaluate_contacts(w, cells);
    const auto whole = measure(w, work);
    for (const std::int64_t cell : cells) {
      EXPECT_EQ(found.pressure.at(cell), whole.at(cell).pressure);
      EXPECT_NE(found.pressure.at(cell), 0);
    }
    std::vector<std::int64_t> lineage;
    for (const std::size_t lane : work.dcm.lane_of_body)
      lineage.push_back(w.state.dcm.lineage[lane]);
    lineage.insert(lineage.end(), w.state.cbm.lineage.begin(), w.state.cbm.lineage.end());
    PairForces all;
    visit_contacts(w, work, [&](const ContactForce& f) {
      const std::int64_t a = lineage[f.a], b = f.b == kNoCell ? kNoPartner : lineage[f.b];
      if (f.fades || a == b || !(cells.contains(a) || cells.contains(b))) return;
      const bool swap = b != kNoPartner && b < a;
      all[swap ? std::pair(b, a) : std::pair(a, b)].force += swap ? Vec3(-f.force) : f.force;
    });
    for (const auto& [pair, sum] : all) {
      const auto same = found.pair.find(pair);
      if (same == found.pair.end())
        EXPECT_EQ(sum.force, Vec3::Zero());  // within the range of another cell's contacts
      else
        EXPECT_EQ(same->second.force, sum.force);
    }
    EXPECT_GE(found.pair.size(), 11u);
  }
}

// In liquid nothing but the fading force acts on two cells that have come apart.
TEST(Zoom, AFadingForceDoesNotDriveCellsAway) {
  World w =
      make_test_world({{Vec3::Zero(), false}, {Vec3(24, 0, 0), false}, {Vec3(300, 0, 0), false}});
  for (cbm::Params& p : w.params.cbm) p.medium_friction *= 1e-4;
  w.params.zoom.fade = 3600;
  w.params.numerics.max_move = 0.25;
  const std::int64_t a = w.state.cbm.lineage[0], b = w.state.cbm.lineage[1];
  PairForces before;
  before[{a, b}] = {Vec3(-2, 0, 0), -24};
  before[{w.state.cbm.lineage[2], kNoPartner}] = {Vec3(0, 2, 0), -24};
  add_fading(w, before, {}, w.state.fading);
  ASSERT_EQ(w.state.fading.size(), 2u);
  SizedWorkspace work(w);
  run(w, work, 600);
  const Vec3 apart = cbm::center_of(w.state.cbm, 1) - cbm::center_of(w.state.cbm, 0);
  EXPECT_GT(apart.x(), 25);  // it does act
  EXPECT_LT(apart.x(), 24 + 0.5 * 12);
  EXPECT_LT(std::abs(cbm::center_of(w.state.cbm, 2).y()), 0.5 * 12);
}

}  // namespace
}  // namespace acinus::coupling
