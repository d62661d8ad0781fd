#include "substances/sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace acinus::substances {
namespace {

/// Voxel below a point along an axis and the share of the one above.
struct Between {
  int low = 0, high = 0;
  double share = 0;
};
Between between(const VoxelGrid& grid, int axis, double x) {
  const double last = grid.n[axis] - 1.0;
  const double place =
      std::clamp((x - grid.low[axis]) / grid.spacing[axis] - 0.5, 0.0, std::max(last, 0.0));
  const int low = std::min(static_cast<int>(place), std::max(grid.n[axis] - 2, 0));
  return {low, std::min(low + 1, grid.n[axis] - 1), place - low};
}

}  // namespace

double interpolate(const VoxelGrid& grid, std::span<const double> field, const Vec3& point) {
  const std::array<Between, 3> at{between(grid, 0, point.x()), between(grid, 1, point.y()),
                                  between(grid, 2, point.z())};
  const auto along_x = [&](int j, int k) {
    return (1 - at[0].share) * field[grid.index(at[0].low, j, k)] +
           at[0].share * field[grid.index(at[0].high, j, k)];
  };
  const auto in_plane = [&](int k) {
    return (1 - at[1].share) * along_x(at[1].low, k) + at[1].share * along_x(at[1].high, k);
  };
  return (1 - at[2].share) * in_plane(at[2].low) + at[2].share * in_plane(at[2].high);
}

Vec3 gradient_at(const VoxelGrid& grid, std::span<const double> field, const Vec3& point) {
  Vec3 gradient = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.n[axis] < 2) continue;
    const double h = grid.spacing[axis], low = grid.low[axis] + h,
                 high = grid.low[axis] + (grid.n[axis] - 1) * h;
    Vec3 before = point, after = point;
    const double middle = low <= high ? std::clamp(point[axis], low, high) : point[axis];
    before[axis] = middle - 0.5 * h;
    after[axis] = middle + 0.5 * h;
    gradient[axis] = (interpolate(grid, field, after) - interpolate(grid, field, before)) / h;
  }
  return gradient;
}

}  // namespace acinus::substances
