/// Inner cells of a clump, means over them, and radii of capsules.

#include "calibration/compression.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/wall.hpp"

namespace acinus::calibration {
namespace {

/// Cells on a line through the middle of a capsule of 50 um, with their place as force.
ClumpSnapshot line() {
  ClumpSnapshot m;
  for (const double x : {-36.0, -20.0, 0.0, 21.0, 34.0}) {
    m.center.emplace_back(x, 0, 0);
    m.radius.push_back(12);
    m.force.push_back(x);
  }
  m.capsule = 50;
  return m;
}

TEST(Clump, InnerCellsStandAwayFromTheCapsuleWhenItBeginsToPress) {
  const auto inner = [](double capsule) {
    std::vector<ClumpSnapshot> history(3, line());
    history[0].force.assign(5, 1);
    history[1].force.assign(5, 20);
    history[2].force.assign(5, 100);
    history[0].capsule = 90;
    history[1].capsule = capsule;
    history[2].capsule = 13;
    return find_inner_cells(history, Vec3::Zero());
  };
  EXPECT_EQ(inner(50), (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(inner(37), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(inner(14), (std::vector<std::size_t>{2})) << "never none";
  EXPECT_TRUE(find_inner_cells({}, Vec3::Zero()).empty());
  std::vector<ClumpSnapshot> pulls(2, line());
  for (ClumpSnapshot& m : pulls) m.force.assign(5, -1);
  EXPECT_EQ(find_inner_cells(pulls, Vec3::Zero()).size(), 4u);
}

TEST(Clump, BulkIsTheMeanOfInnerCells) {
  const Bulk b = measure_bulk(line(), {2, 3});
  EXPECT_NEAR(b.force, 10.5, 1e-14);
  const double middle = (1 - 20.0 / 24) + (1 - 21.0 / 24),
               right = (1 - 21.0 / 24) + (1 - 13.0 / 24);
  EXPECT_NEAR(b.overlap, (middle + right) / 2 / 12, 1e-14);
}

/// Capsules that shrink by 1 um from snapshot to snapshot; the force is that of a capsule wider by
/// `excess`.
std::vector<ClumpSnapshot> history(double excess) {
  std::vector<ClumpSnapshot> h;
  for (int k = 0; k <= 20; ++k) {
    ClumpSnapshot m = line();
    m.capsule = 60 - k;
    m.force.assign(m.center.size(), 3 * std::exp(0.2 * (45 - (m.capsule - excess))));
    h.push_back(m);
  }
  return h;
}

TEST(Wall, ExcessIsHowMuchWiderACapsuleBearsTheSame) {
  const Compression cells{history(0), {2}};
  EXPECT_NEAR(capsule_excess(cells, history(0), 1), 0, 1e-12);
  // Forces between moments are linear, not exponential: an error of the second order.
  EXPECT_NEAR(capsule_excess(cells, history(0.7), 1), 0.7, 0.03);
  EXPECT_NEAR(capsule_excess(cells, history(-2), 1), -2, 1e-12);
  EXPECT_TRUE(std::isnan(capsule_excess(cells, history(-100), 1))) << "never as much";
  EXPECT_TRUE(std::isnan(capsule_excess(cells, history(0), 0.01))) << "no snapshot counts";
}

}  // namespace
}  // namespace acinus::calibration
