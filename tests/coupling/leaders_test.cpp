/// Choice of leading cells.

#include "coupling/migration/leaders.hpp"

#include <gtest/gtest.h>

#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

using Choice = std::vector<std::uint8_t>;

/// Cell of 12 um at a distance, angle in degrees and height.
PolarCell cell(double distance, double degrees, double height = 0) {
  return {distance, degrees * kPi / 180, height, 12, true, false};
}

Motility by(Leaders rule) {
  Motility m;
  m.leaders = rule;
  m.axis_radius = 10;
  return m;
}

/// Sides of a pie of 60 degrees with its tip at the vein axis.
std::vector<contact::Plane> pie_walls() {
  contact::Plane low, high;
  low.normal = Vec3(0.5, std::sqrt(0.75), 0);
  high.normal = Vec3(0.5, -std::sqrt(0.75), 0);
  return {low, high};
}

/// Two rows of cells around the vein, side by side, the second behind the gaps of the first.
std::vector<PolarCell> two_rows() {
  std::vector<PolarCell> cells;
  for (double angle : {-20.0, -10.0, 0.0, 10.0}) cells.push_back(cell(140, angle));
  for (double angle : {-15.0, -5.0, 5.0}) cells.push_back(cell(161, angle));
  return cells;
}

TEST(Leaders, OfTheFrontAreAllOfTheFirstRowAndNoneOfTheSecond) {
  EXPECT_EQ(find_leaders(by(Leaders::kFront), two_rows()), (Choice{1, 1, 1, 1, 0, 0, 0}));
}

TEST(Leaders, OfTheFrontStandAboveEachOtherToo) {
  std::vector<PolarCell> cells{cell(140, 0, 12), cell(150, 0, 36), cell(145, 0, 60)};
  EXPECT_EQ(find_leaders(by(Leaders::kFront), cells), (Choice{1, 1, 1}));
  cells[1].height = 24;  // now behind the first, as the next slice begins at 24
  EXPECT_EQ(find_leaders(by(Leaders::kFront), cells), (Choice{1, 0, 1}));
}

TEST(Leaders, OfTheFrontDoNotMindCellsBeyondTheVein) {
  const std::vector<PolarCell> cells{cell(140, 0), cell(60, 180), cell(60, 95)};
  EXPECT_EQ(find_leaders(by(Leaders::kFront), cells), (Choice{1, 1, 1}));
}

TEST(Leaders, OfTheBorderAreThoseBesideACellThatRanAhead) {
  const std::vector<PolarCell> cells{cell(140, -5), cell(140, 5), cell(117, 0)};
  EXPECT_EQ(find_leaders(by(Leaders::kFront), cells), (Choice{0, 0, 1}));
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), cells), (Choice{1, 1, 1}));
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), two_rows()), (Choice{1, 1, 1, 1, 0, 0, 0}));
}

TEST(Leaders, OfTheBorderAreThoseOfAFrontAtAnAngleToTheVein) {
  // A row that recedes by half a diameter a cell: each bars the straight way of the next.
  std::vector<PolarCell> cells;
  for (int k = 0; k < 4; ++k) cells.push_back(cell(140 + 18 * k, 5.0 * k));
  EXPECT_EQ(find_leaders(by(Leaders::kFront), cells), (Choice{1, 0, 0, 0}));
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), cells), (Choice{1, 1, 1, 1}));
}

TEST(Leaders, OfTheBorderDoNotTakeAWallForTheLesion) {
  // The way beside the cell ahead leads through the wall.
  const std::vector<PolarCell> cells{cell(140, 0), cell(110, 0)};
  contact::Plane left, right;
  left.point = Vec3(0, 14, 0);
  left.normal = -Vec3::UnitY();
  right.point = Vec3(0, -14, 0);
  right.normal = Vec3::UnitY();
  const std::vector<contact::Plane> walls{left, right};
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), cells), (Choice{1, 1}));
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), cells, walls), (Choice{0, 1}));
  // Where walls meet behind the vein the way ends at the vein.
  EXPECT_EQ(find_leaders(by(Leaders::kBorder), std::vector{cell(40, 0)}, pie_walls()), (Choice{1}));
}

TEST(Leaders, ForemostCellsKeepADiameterApart) {
  std::vector<PolarCell> cells = two_rows();
  for (std::size_t k = 0; k < 4; ++k) cells[k].distance -= static_cast<double>(k % 2);
  // 10 degrees at 140 um are 24.4 um of arc: just beyond a diameter.
  EXPECT_EQ(find_leaders(by(Leaders::kForemost), cells), (Choice{1, 1, 1, 1, 0, 0, 0}));
  for (PolarCell& c : cells) c.angle *= 0.9;
  EXPECT_EQ(find_leaders(by(Leaders::kForemost), cells), (Choice{0, 1, 0, 1, 0, 0, 0}));
}

TEST(Leaders, OfSectorsAreOnePerSectorAndSlice) {
  Motility m = by(Leaders::kSector);
  m.leader_count = 12;
  m.leader_slice = 24;
  // Two in the sector from 0 to 30 degrees, one above them, one alone, one in the last sector.
  const std::vector<PolarCell> cells{cell(140, 5), cell(130, 25), cell(150, 10, 30), cell(99, 70),
                                     cell(120, -1)};
  EXPECT_EQ(find_leaders(m, cells), (Choice{0, 1, 1, 1, 1}));
}

TEST(Leaders, NearestAreAsManyAsAskedFor) {
  Motility m = by(Leaders::kNearest);
  m.leader_count = 2;
  std::vector<PolarCell> cells{cell(140, 5), cell(21, 25), cell(130, 70), cell(120, 120)};
  EXPECT_EQ(find_leaders(m, cells), (Choice{0, 0, 1, 1})) << "the second is at the vein's wall";
  cells[2].exists = false;
  EXPECT_EQ(find_leaders(m, cells), (Choice{1, 0, 0, 1}));
}

TEST(Leaders, KeepTheirPlaceUntilAnotherIsNearerByASixthOfARadius) {
  for (Leaders rule : {Leaders::kForemost, Leaders::kFront, Leaders::kSector, Leaders::kNearest}) {
    Motility m = by(rule);
    m.leader_count = 1;
    m.leader_slice = 100;
    std::vector<PolarCell> cells{cell(140, 4), cell(138.1, 8)};
    cells[0].led = true;
    if (rule == Leaders::kForemost) {
      // The challenger is nearer, so it leads as well: nothing nearer bars it.
      EXPECT_EQ(find_leaders(m, cells), (Choice{1, 1}));
    } else if (rule == Leaders::kFront) {
      EXPECT_EQ(find_leaders(m, cells), (Choice{1, 1}));
    } else {
      EXPECT_EQ(find_leaders(m, cells), (Choice{1, 0}));
    }
    cells[1].distance = 137.9;
    EXPECT_EQ(find_leaders(m, cells), (Choice{0, 1}));
  }
}

// Cells stand in every way from the first one but the straight one, which they leave this narrow.
std::vector<PolarCell> behind_a_gate(double half_width, bool led) {
  std::vector<PolarCell> cells{cell(140, 0)};
  cells[0].led = led;
  const double r = cells[0].radius;
  for (const double side : {-1.0, 1.0})
    for (const auto& [along, aside] : {std::pair{3.0, half_width}, {2.12, 2.12}}) {
      PolarCell other = cells[0];
      other.led = false;
      other.distance = std::hypot(140 - along * r, aside * r);
      other.angle = side * std::atan2(aside * r, 140 - along * r);
      cells.push_back(other);
    }
  return cells;
}

TEST(Leaders, AtTheBorderKeepTheirPlaceInANarrowerWay) {
  const Motility m = by(Leaders::kBorder);
  EXPECT_EQ(find_leaders(m, behind_a_gate(1.35, false))[0], 1);
  EXPECT_EQ(find_leaders(m, behind_a_gate(1.25, false))[0], 0);
  EXPECT_EQ(find_leaders(m, behind_a_gate(1.25, true))[0], 1);
  EXPECT_EQ(find_leaders(m, behind_a_gate(1.05, true))[0], 0);
}

TEST(Leaders, OfTheBorderTakeMovingWallsWhereTheyAre) {
  World w = make_test_world({{Vec3(140, 0, 0), false}, {Vec3(110, 0, 0), false}});
  w.params.motility = by(Leaders::kBorder);
  w.params.motility.leader_grid = 10;
  for (const double side : {1.0, -1.0}) {
    contact::Plane wall;
    wall.point = side * Vec3(0, 214, 0);
    wall.normal = -side * Vec3::UnitY();
    wall.speed = 1;
    wall.travel = 300;
    w.params.boundary.planes.push_back(wall);
  }
  w.state.clock.phase = Phase::kRun;
  w.state.clock.origin = 50;
  const std::vector<double> radius{12, 12};
  Choice leader;
  std::int64_t interval = -1;
  w.state.clock.time = 200;  // 64 um from the cells
  choose_leaders(w.params, w.state, {}, radius, leader, interval);
  EXPECT_EQ(leader, (Choice{1, 1}));
  w.state.clock.time = 250;  // 14 um from them
  choose_leaders(w.params, w.state, {}, radius, leader, interval);
  EXPECT_EQ(leader, (Choice{0, 1}));
}

TEST(Leaders, AreChosenOncePerIntervalOfTheirGrid) {
  World w = make_test_world({{Vec3(140, 0, 0)}, {Vec3(165, 0, 0), false}}, 60, 42);
  w.params.motility = by(Leaders::kFront);
  w.params.motility.leader_grid = 600;
  Choice leader;
  std::int64_t interval = -1;
  const std::vector<double> one{12, 12, 12, 12, 12, 12, 12, 12};
  EXPECT_TRUE(choose_leaders(w.params, w.state, one, one, leader, interval));
  EXPECT_EQ(leader[0], 1);
  EXPECT_EQ(leader[8], 0) << "the sphere stands behind";
  w.state.clock.time = 599;
  EXPECT_FALSE(choose_leaders(w.params, w.state, one, one, leader, interval));
  w.state.clock.time = 600;
  EXPECT_TRUE(choose_leaders(w.params, w.state, one, one, leader, interval));
}

}  // namespace
}  // namespace acinus::coupling
