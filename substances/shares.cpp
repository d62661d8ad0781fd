#include "substances/shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/sphere.hpp"
#include "substances/crossings.hpp"

namespace acinus::substances {
namespace {

/// Vertical columns across a body and across a voxel, at least.
constexpr double kColumnsAcross = 8, kColumnsPerVoxel = 4;

/// Voxels around a body, and the lengths of columns in them.
class Columns {
 public:
  Columns(const VoxelGrid& grid, const Box& body) : grid_(grid), bottom_(body.low.z()) {
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = grid.voxel_at(axis, body.low[axis]);
      count_[axis] = grid.voxel_at(axis, body.high[axis]) - first_[axis] + 1;
      const double across = body.high[axis] - body.low[axis];
      pitch_[axis] =
          grid.spacing[axis] /
          std::ceil(std::max(kColumnsPerVoxel, kColumnsAcross * grid.spacing[axis] / across));
      column_[axis] =
          static_cast<long>(std::floor((body.low[axis] - grid.low[axis]) / pitch_[axis]));
      n_column_[axis] = static_cast<long>(
          std::floor((body.high[axis] - grid.low[axis]) / pitch_[axis]) - column_[axis] + 1);
    }
    length_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], 0.0);
  }

  double at(int axis, long column) const {
    return grid_.low[axis] + (static_cast<double>(column) + 0.5) * pitch_[axis];
  }
  long first_column(int axis, double from) const {
    const auto n = static_cast<long>(std::ceil((from - grid_.low[axis]) / pitch_[axis] - 0.5));
    return std::max(n, column_[axis]);
  }
  long end_column(int axis) const { return column_[axis] + n_column_[axis]; }

  /// ColumnPlaces of the columns along an axis, for for_each_crossing.
  struct ColumnPlaces {
    const Columns& columns;
    int axis;
    double at(long k) const { return columns.at(axis, k); }
    long first(double from) const { return columns.first_column(axis, from); }
    long end() const { return columns.end_column(axis); }
  };
  ColumnPlaces along(int axis) const { return {*this, axis}; }

  /// Adds sign times the column (x, y) from the bottom of the body up to z.
  void add(double x, double y, double z, double sign) {
    const int i = grid_.voxel_at(0, x) - first_[0], j = grid_.voxel_at(1, y) - first_[1];
    double* to = length_.data() + (static_cast<std::size_t>(j) * count_[0] + i) * count_[2];
    for (int k = 0; k < count_[2]; ++k) {
      const double floor = k == 0 ? bottom_ : grid_.low.z() + (first_[2] + k) * grid_.spacing.z();
      const double ceiling = floor_of(k + 1);
      if (z <= floor) return;
      to[k] += sign * (std::min(z, ceiling) - floor);
    }
  }

  /// Shares that sum to `volume`.
  std::vector<VoxelShare> finish(double volume, const Vec3& center) const {
    double sum = 0;
    for (const double v : length_) sum += std::max(v, 0.0);
    if (!(sum > 0)) return {{grid_.index_at(center), volume}};
    std::vector<VoxelShare> shares;
    for (int k = 0; k < count_[2]; ++k)
      for (int j = 0; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) {
          const double v = length_[(static_cast<std::size_t>(j) * count_[0] + i) * count_[2] + k];
          if (v > 0)
            shares.push_back(
                {grid_.index(first_[0] + i, first_[1] + j, first_[2] + k), v / sum * volume});
        }
    return shares;
  }

 private:
  double floor_of(int k) const {
    return k >= count_[2] ? 1e300 : grid_.low.z() + (first_[2] + k) * grid_.spacing.z();
  }

  const VoxelGrid& grid_;
  double bottom_;
  std::array<int, 3> first_{}, count_{};
  std::array<double, 3> pitch_{};  ///< um between columns; those along z are not used
  std::array<long, 3> column_{}, n_column_{};
  std::vector<double> length_;  ///< [y][x][z] um
};

double volume_inside(std::span<const Vec3> node, std::span<const std::array<int, 3>> triangle,
                     const Vec3& center) {
  double sum = 0;
  for (const auto& [a, b, c] : triangle)
    sum += (node[a] - center).dot((node[b] - center).cross(node[c] - center));
  return sum / 6;
}

/// Points of a surface, at most this far apart in voxels.
constexpr double kPointsApart = 1.0 / 3;

/// Joins the shares of a voxel, in order of voxels, and scales them to a sum.
std::vector<VoxelShare> join_shares(std::vector<VoxelShare> part, double sum) {
  std::ranges::stable_sort(part, {}, &VoxelShare::voxel);
  std::vector<VoxelShare> joined;
  double all = 0;
  for (const VoxelShare& p : part) {
    all += p.volume;
    if (joined.empty() || joined.back().voxel != p.voxel)
      joined.push_back(p);
    else
      joined.back().volume += p.volume;
  }
  for (VoxelShare& p : joined) p.volume *= sum / all;
  return joined;
}

}  // namespace

void Shares::add(std::span<const VoxelShare> body) {
  share.insert(share.end(), body.begin(), body.end());
  start.push_back(share.size());
}

std::vector<VoxelShare> share_sphere(const VoxelGrid& grid, const Vec3& center, double radius) {
  Columns columns(grid, sphere_box(center, radius));
  for (long j = columns.first_column(1, center.y() - radius); j < columns.end_column(1); ++j)
    for (long i = columns.first_column(0, center.x() - radius); i < columns.end_column(0); ++i) {
      const double x = columns.at(0, i), y = columns.at(1, j);
      const double half2 = radius * radius - (x - center.x()) * (x - center.x()) -
                           (y - center.y()) * (y - center.y());
      if (half2 <= 0) continue;
      const double half = std::sqrt(half2);
      columns.add(x, y, center.z() + half, 1);
      columns.add(x, y, center.z() - half, -1);
    }
  return columns.finish(sphere_volume(radius), center);
}

std::vector<VoxelShare> share_surface(const VoxelGrid& grid, std::span<const Vec3> node,
                                      std::span<const std::array<int, 3>> triangle) {
  Box box;
  for (const Vec3& x : node) box.include(x);
  const Vec3 center = 0.5 * (box.low + box.high);
  Columns columns(grid, box);
  for_each_crossing(node, triangle, 2, columns.along(0), columns.along(1),
                    [&](long i, long j, double z, int turn) {
                      columns.add(columns.at(0, i), columns.at(1, j), z, turn);
                    });
  return columns.finish(std::max(0.0, volume_inside(node, triangle, center)), center);
}

std::vector<VoxelShare> share_sphere_by_area(const VoxelGrid& grid, const Vec3& center,
                                             double radius) {
  constexpr double kLeastPoints = 100;
  const double apart = kPointsApart * grid.spacing.minCoeff();
  const auto n = static_cast<int>(
      std::ceil(std::max(kLeastPoints, 4 * kPi * radius * radius / (apart * apart))));
  // Points of equal area on a spiral.
  const double turn = kPi * (3 - std::sqrt(5.0));
  std::vector<VoxelShare> part;
  for (int k = 0; k < n; ++k) {
    const double z = 1 - (2 * k + 1.0) / n, across = std::sqrt(1 - z * z);
    const Vec3 x(across * std::cos(turn * k), across * std::sin(turn * k), z);
    part.push_back({grid.index_at(center + radius * x), 1});
  }
  return join_shares(std::move(part), sphere_volume(radius));
}

std::vector<VoxelShare> share_surface_by_area(const VoxelGrid& grid, std::span<const Vec3> node,
                                              std::span<const std::array<int, 3>> triangle) {
  const double apart = kPointsApart * grid.spacing.minCoeff();
  std::vector<VoxelShare> part;
  Box box;
  for (const Vec3& x : node) box.include(x);
  for (const auto& [a, b, c] : triangle) {
    const Vec3 &o = node[a], u = node[b] - o, v = node[c] - o;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / apart)));
    const double area = 0.5 * u.cross(v).norm() / (n * n);
    // Middles of n^2 equal triangles: upright ones, and those between them.
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        const auto add = [&](double third) {
          part.push_back({grid.index_at(o + ((i + third) * u + (j + third) * v) / n), area});
        };
        add(1.0 / 3);
        if (i + j + 1 < n) add(2.0 / 3);
      }
  }
  return join_shares(std::move(part),
                     std::max(0.0, volume_inside(node, triangle, 0.5 * (box.low + box.high))));
}

double mean_over(std::span<const VoxelShare> body, std::span<const double> field) {
  double sum = 0, volume = 0;
  for (const VoxelShare& s : body) {
    sum += s.volume * field[s.voxel];
    volume += s.volume;
  }
  return volume > 0 ? sum / volume : 0;
}

}  // namespace acinus::substances
