#include "substances/shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/sphere.hpp"

namespace acinus::substances {
namespace {

/// Vertical columns across a body and across a voxel, at least.
constexpr double kColumnsAcross = 8, kColumnsPerVoxel = 4;

/// Voxels around a body, and the lengths of columns in them.
class Columns {
 public:
  Columns(const VoxelGrid& grid, const Box& body) : grid_(grid), bottom_(body.low.z()) {
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = voxel_at(axis, body.low[axis]);
      count_[axis] = voxel_at(axis, body.high[axis]) - first_[axis] + 1;
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

  /// Adds sign times the column (x, y) from the bottom of the body up to z.
  void add(double x, double y, double z, double sign) {
    const int i = voxel_at(0, x) - first_[0], j = voxel_at(1, y) - first_[1];
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
    if (!(sum > 0))
      return {
          {grid_.index(voxel_at(0, center.x()), voxel_at(1, center.y()), voxel_at(2, center.z())),
           volume}};
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
  int voxel_at(int axis, double x) const {
    const double place = std::floor((x - grid_.low[axis]) / grid_.spacing[axis]);
    return static_cast<int>(std::clamp(place, 0.0, grid_.n[axis] - 1.0));
  }
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

/// Position of a point relative to the directed edge a -> b, seen from above: +1 left, -1 right.
/// Both triangles of an edge get opposite answers, also for points on it.
struct ProjectedNode {
  int index;
  double x, y;
};
int side_of(const ProjectedNode& a, const ProjectedNode& b, double x, double y) {
  const bool flipped = a.index > b.index;
  const ProjectedNode &p = flipped ? b : a, &q = flipped ? a : b;
  const double e = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
  return (e >= 0) != flipped ? 1 : -1;
}

double volume_inside(std::span<const Vec3> node, std::span<const std::array<int, 3>> triangle,
                     const Vec3& center) {
  double sum = 0;
  for (const auto& [a, b, c] : triangle)
    sum += (node[a] - center).dot((node[b] - center).cross(node[c] - center));
  return sum / 6;
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
  for (const auto& t : triangle) {
    const Vec3 &a = node[t[0]], &b = node[t[1]], &c = node[t[2]];
    const Vec3 normal = (b - a).cross(c - a);
    if (normal.z() == 0) continue;
    const ProjectedNode p{t[0], a.x(), a.y()}, q{t[1], b.x(), b.y()}, r{t[2], c.x(), c.y()};
    const double right = std::max({p.x, q.x, r.x}), top = std::max({p.y, q.y, r.y});
    const int turn = normal.z() > 0 ? 1 : -1;
    for (long j = columns.first_column(1, std::min({p.y, q.y, r.y}));
         j < columns.end_column(1) && columns.at(1, j) <= top; ++j)
      for (long i = columns.first_column(0, std::min({p.x, q.x, r.x}));
           i < columns.end_column(0) && columns.at(0, i) <= right; ++i) {
        const double x = columns.at(0, i), y = columns.at(1, j);
        if (side_of(p, q, x, y) != turn || side_of(q, r, x, y) != turn ||
            side_of(r, p, x, y) != turn)
          continue;
        const double z = a.z() - ((x - a.x()) * normal.x() + (y - a.y()) * normal.y()) / normal.z();
        columns.add(x, y, z, turn);
      }
  }
  return columns.finish(std::max(0.0, volume_inside(node, triangle, center)), center);
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
