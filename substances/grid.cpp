#include "substances/grid.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::substances {
namespace {

/// Share of a voxel by which a box may exceed whole voxels: round-off of its corners.
constexpr double kRoundOff = 1e-9;

double count_along(double length, double longest) {
  return std::max(1.0, std::ceil(length / longest - kRoundOff));
}

}  // namespace

VoxelGrid make_grid(const Box& box, double longest) {
  VoxelGrid grid;
  grid.low = box.low;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.high[axis] - box.low[axis], n = count_along(length, longest);
    grid.n[axis] = static_cast<int>(n);
    grid.spacing[axis] = length / n;
  }
  return grid;
}

double count_voxels(const Box& box, double longest) {
  double n = 1;
  for (int axis = 0; axis < 3; ++axis) n *= count_along(box.high[axis] - box.low[axis], longest);
  return n;
}

}  // namespace acinus::substances
