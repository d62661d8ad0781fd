/// Depth of cells behind the edge of the lesion, in cells.

#include "coupling/migration/lesion_layers.hpp"

#include <gtest/gtest.h>

namespace acinus::coupling {
namespace {

LayerCell at(double x, double y, double z = 0) { return {Vec3(x, y, z), 12}; }

TEST(LesionLayers, AreCountedFromTheEdgeBeforeACell) {
  // A row with centres 20 um apart (cells of 24 um), and to its side one that begins farther out.
  const std::vector<LayerCell> cells{at(50, 0),  at(70, 0), at(90, 0),
                                     at(110, 0), at(0, 90), at(0, 110)};
  EXPECT_EQ(compute_layers(cells, Vec3::Zero()), (std::vector<int>{1, 2, 3, 4, 1, 2}));
}

TEST(LesionLayers, AreSharedByCellsLessThanHalfADiameterBehindEachOther) {
  EXPECT_EQ(compute_layers(std::vector{at(0, -55), at(0, -62, 10), at(5, -66)}, Vec3::Zero()),
            (std::vector<int>{1, 1, 1}));
}

TEST(LesionLayers, BeginAnewOneDiameterHigherOrAside) {
  EXPECT_EQ(compute_layers(std::vector{at(50, 0), at(75, 0, 23)}, Vec3::Zero()),
            (std::vector<int>{1, 2}));
  EXPECT_EQ(compute_layers(std::vector{at(50, 0), at(75, 0, 25)}, Vec3::Zero()),
            (std::vector<int>{1, 1}));
  EXPECT_EQ(compute_layers(std::vector{at(50, 0), at(70, 25)}, Vec3::Zero()),
            (std::vector<int>{1, 1}));
}

TEST(LesionLayers, AreCountedFromTheAxis) {
  EXPECT_EQ(compute_layers(std::vector{at(150, 7), at(174, 7)}, Vec3(100, 7, 0)),
            (std::vector<int>{1, 2}));
}

TEST(LesionLayers, OfAllCellsAreThoseOfEach) {
  std::vector<LayerCell> cells;
  for (int k = 0; k < 300; ++k)
    cells.push_back({Vec3(40 + 97 * k % 211, 31 * k % 173 - 80, 53 * k % 67), 8.0 + k % 5});
  const Vec3 axis(20, 10, 0);
  const std::vector<int> all = compute_layers(cells, axis);
  for (std::size_t k = 0; k < cells.size(); ++k)
    EXPECT_EQ(all[k], local_layer_of(cells[k], cells, axis)) << k;
}

}  // namespace
}  // namespace acinus::coupling
