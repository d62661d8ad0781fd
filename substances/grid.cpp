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

VoxelGrid extend_grid(const VoxelGrid& grid, const Layers& layers) {
  VoxelGrid wide = grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int below = layers[2 * axis], above = layers[2 * axis + 1];
    wide.low[static_cast<int>(axis)] -= below * grid.spacing[static_cast<int>(axis)];
    wide.n[axis] += below + above;
  }
  return wide;
}

std::vector<double> extend_field(const VoxelGrid& grid, const Layers& layers,
                                 std::span<const double> field,
                                 const std::array<double, 6>& outside) {
  const VoxelGrid wide = extend_grid(grid, layers);
  std::vector<double> value(wide.n_voxel());
  for (int k = 0; k < wide.n[2]; ++k)
    for (int j = 0; j < wide.n[1]; ++j)
      for (int i = 0; i < wide.n[0]; ++i) {
        const std::array<int, 3> old{i - layers[0], j - layers[2], k - layers[4]};
        double& v = value[wide.index(i, j, k)];
        int face = -1;
        for (int axis = 0; axis < 3; ++axis) {
          if (old[axis] < 0) face = 2 * axis;
          if (old[axis] >= grid.n[axis]) face = 2 * axis + 1;
        }
        v = face < 0 ? field[grid.index(old[0], old[1], old[2])] : outside[face];
      }
  return value;
}

double count_voxels(const Box& box, double longest) {
  double n = 1;
  for (int axis = 0; axis < 3; ++axis) n *= count_along(box.high[axis] - box.low[axis], longest);
  return n;
}

}  // namespace acinus::substances
