#include "substances/cover.hpp"

#include <algorithm>
#include <cmath>

#include "core/box.hpp"
#include "core/sphere.hpp"
#include "substances/crossings.hpp"
#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Lines across a voxel and across a body, at least.
constexpr double kLinesPerVoxel = 4, kLinesAcross = 12;
/// Fractions so close to 0 or 1 are round-off.
constexpr double kRoundOff = 1e-12;

/// Voxels of a grid around a body, in voxels along each axis.
struct VoxelBlock {
  std::array<int, 3> first{}, count{};

  VoxelBlock(const VoxelGrid& grid, const Box& body) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto voxel = [&](double x) {
        return std::clamp(std::floor((x - grid.low[axis]) / grid.spacing[axis]), -1.0,
                          static_cast<double>(grid.n[axis]));
      };
      first[axis] = std::max(0, static_cast<int>(voxel(body.low[axis])));
      const int last = std::min(grid.n[axis] - 1, static_cast<int>(voxel(body.high[axis])));
      count[axis] = std::max(0, last - first[axis] + 1);
    }
  }
  bool empty() const { return count[0] == 0 || count[1] == 0 || count[2] == 0; }
  std::size_t n_voxel() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
};

/// Calls f(i, j, k) for all numbers below n, the first fastest.
template <class F>
void for_each_of(const std::array<int, 3>& n, const F& f) {
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) f(i, j, k);
}

void add_part(std::size_t at, double fraction, std::vector<CoveredPart>& to) {
  if (fraction > kRoundOff) to.push_back({at, fraction > 1 - kRoundOff ? 1 : fraction});
}

/// Areas of a disc below lines of a grid: the disc is about the origin.
class DiscCorners {
 public:
  DiscCorners(double radius, std::span<const double> x, std::span<const double> y)
      : radius_(radius), below_x_(x.size()), below_y_(y.size()) {
    for (std::size_t i = 0; i < x.size(); ++i) below_x_[i] = below(x[i]);
    for (std::size_t j = 0; j < y.size(); ++j) below_y_[j] = below(y[j]);
  }

  /// Area left of x = x_i and below y = y_j.
  double corner(std::span<const double> x, std::span<const double> y, std::size_t i,
                std::size_t j) const {
    const double all = kPi * radius_ * radius_, a = below_x_[i], b = below_y_[j];
    if (x[i] <= -radius_ || y[j] <= -radius_) return 0;
    if (x[i] >= radius_) return b;
    if (y[j] >= radius_) return a;
    if (x[i] * x[i] + y[j] * y[j] < radius_ * radius_)
      return 0.5 * (a + b) - 0.25 * all + x[i] * y[j];
    if (x[i] >= 0) return y[j] >= 0 ? a + b - all : b;
    return y[j] >= 0 ? a : 0;
  }

 private:
  /// Area on one side of a chord.
  double below(double x) const {
    const double s = std::clamp(x / radius_, -1.0, 1.0);
    return radius_ * radius_ * (0.5 * kPi + std::asin(s) + s * std::sqrt(1 - s * s));
  }
  double radius_;
  std::vector<double> below_x_, below_y_;
};

/// Calls f(i, j, fraction) for the rectangles of a block that a disc covers, in voxels of the block
/// along the axes u and v.
template <class F>
void for_each_covered(const VoxelGrid& grid, const VoxelBlock& block, const Vec3& center, int u,
                      int v, double radius, const F& f) {
  const auto places = [&](int axis) {
    std::vector<double> x(static_cast<std::size_t>(block.count[axis]) + 1);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] =
          grid.low[axis] +
          (static_cast<double>(block.first[axis]) + static_cast<double>(i)) * grid.spacing[axis] -
          center[axis];
    return x;
  };
  const std::vector<double> x = places(u), y = places(v);
  const DiscCorners disc(radius, x, y);
  const double area = grid.spacing[u] * grid.spacing[v];
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double inside = disc.corner(x, y, i + 1, j + 1) - disc.corner(x, y, i, j + 1) -
                            disc.corner(x, y, i + 1, j) + disc.corner(x, y, i, j);
      if (inside > kRoundOff * area) f(static_cast<int>(i), static_cast<int>(j), inside / area);
    }
}

/// Lines with equal distances. Lines on faces are shifted by a little, so that nodes that lie on
/// faces are on one side.
struct EvenLines {
  double origin, pitch;
  long begin, past;
  double at(long k) const { return origin + static_cast<double>(k) * pitch; }
  long first(double from) const {
    return std::max(begin, static_cast<long>(std::ceil((from - origin) / pitch)));
  }
  long end() const { return past; }
};

/// Adds sign times the part of a line below a height to a row of fractions, in voxels.
void add_line(double height, double sign, int n, double* row) {
  for (int k = 0; k < n; ++k) {
    if (height <= k) return;
    row[k] += sign * std::min(height - k, 1.0);
  }
}

/// Cuts lines along an axis and calls to(u line, v line) for the row that takes a line.
struct LineCutter {
  const VoxelGrid& grid;
  const VoxelBlock& block;
  std::span<const Vec3> node;
  std::span<const std::array<int, 3>> triangle;
  std::array<int, 3> per_voxel;

  EvenLines inside_voxels(int axis) const {
    const double pitch = grid.spacing[axis] / per_voxel[axis];
    const long begin = static_cast<long>(block.first[axis]) * per_voxel[axis];
    return {grid.low[axis] + 0.5 * pitch, pitch, begin,
            begin + static_cast<long>(block.count[axis]) * per_voxel[axis]};
  }
  EvenLines on_faces(int axis) const {
    constexpr double kShift = 1e-7;
    return {grid.low[axis] + kShift * grid.spacing[axis], grid.spacing[axis], block.first[axis],
            block.first[axis] + block.count[axis] + 1L};
  }
  template <class Us, class To>
  void cut(int along, const Us& us, double weight, const To& to) const {
    const double low = grid.low[along] + block.first[along] * grid.spacing[along];
    for_each_crossing(node, triangle, along, us, inside_voxels((along + 2) % 3),
                      [&](long i, long j, double w, int turn) {
                        add_line((w - low) / grid.spacing[along], weight * turn, block.count[along],
                                 to(i, j));
                      });
  }
};

}  // namespace

Cover cover_sphere(const VoxelGrid& grid, const Vec3& center, double radius) {
  Cover cover;
  const VoxelBlock block(grid, sphere_box(center, radius));
  if (block.empty()) return cover;
  const auto disc_radius = [&](double height) {
    return std::sqrt(std::max(0.0, radius * radius - height * height));
  };
  // Four points of Gauss' rule on -1..1.
  constexpr std::array<double, 4> kPoint{-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                         0.861136311594053},
      kWeight{0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const double h = grid.spacing.z();
  std::vector<double> layer(block.n_voxel() / static_cast<std::size_t>(block.count[2]));
  for (int k = 0; k < block.count[2]; ++k) {
    const double floor = grid.low.z() + (block.first[2] + k) * h - center.z();
    const double low = std::max(floor, -radius), high = std::min(floor + h, radius);
    if (!(low < high)) continue;
    std::ranges::fill(layer, 0.0);
    for (std::size_t q = 0; q < kPoint.size(); ++q) {
      const double height = 0.5 * (low + high) + 0.5 * (high - low) * kPoint[q];
      const double share = 0.5 * (high - low) / h * kWeight[q];
      for_each_covered(
          grid, block, center, 0, 1, disc_radius(height), [&](int i, int j, double fraction) {
            layer[static_cast<std::size_t>(j) * block.count[0] + i] += share * fraction;
          });
    }
    for (int j = 0; j < block.count[1]; ++j)
      for (int i = 0; i < block.count[0]; ++i)
        add_part(grid.index(block.first[0] + i, block.first[1] + j, block.first[2] + k),
                 layer[static_cast<std::size_t>(j) * block.count[0] + i], cover.volume);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int f = 0; f <= block.count[axis]; ++f) {
      const double disc =
          disc_radius(grid.low[axis] + (block.first[axis] + f) * grid.spacing[axis] - center[axis]);
      if (!(disc > 0)) continue;
      for_each_covered(grid, block, center, u, v, disc, [&](int i, int j, double fraction) {
        std::array<int, 3> at{};
        at[axis] = block.first[axis] + f;
        at[u] = block.first[u] + i;
        at[v] = block.first[v] + j;
        add_part(grid.face_index(axis, at[0], at[1], at[2]), fraction, cover.face[axis]);
      });
    }
  }
  return cover;
}

Cover cover_surface(const VoxelGrid& grid, std::span<const Vec3> node,
                    std::span<const std::array<int, 3>> triangle) {
  Cover cover;
  Box box;
  for (const Vec3& x : node) box.include(x);
  const VoxelBlock block(grid, box);
  if (block.empty()) return cover;
  LineCutter cutter{grid, block, node, triangle, {}};
  for (int axis = 0; axis < 3; ++axis)
    cutter.per_voxel[axis] = static_cast<int>(std::ceil(std::max(
        kLinesPerVoxel, kLinesAcross * grid.spacing[axis] / (box.high[axis] - box.low[axis]))));
  // Rows along the lines are contiguous: [v][u][along].
  const auto cut = [&](int along, bool on_faces, std::vector<double>& row) {
    const int u = (along + 1) % 3, v = (along + 2) % 3;
    const int per_u = on_faces ? 1 : cutter.per_voxel[u], per_v = cutter.per_voxel[v];
    const int n_u = block.count[u] + (on_faces ? 1 : 0), n = block.count[along];
    row.assign(static_cast<std::size_t>(n_u) * block.count[v] * n, 0.0);
    cutter.cut(along, on_faces ? cutter.on_faces(u) : cutter.inside_voxels(u), 1.0 / per_u / per_v,
               [&](long i, long j) {
                 const long iu = i / per_u - block.first[u], jv = j / per_v - block.first[v];
                 return row.data() + (static_cast<std::size_t>(jv) * n_u + iu) * n;
               });
  };
  std::vector<double> row;
  cut(2, false, row);
  for_each_of(block.count, [&](int i, int j, int k) {
    add_part(grid.index(block.first[0] + i, block.first[1] + j, block.first[2] + k),
             row[(static_cast<std::size_t>(j) * block.count[0] + i) * block.count[2] + k],
             cover.volume);
  });
  for (int axis = 0; axis < 3; ++axis) {
    const int along = (axis + 2) % 3, v = (axis + 1) % 3;
    cut(along, true, row);
    std::array<int, 3> n = block.count;
    ++n[axis];
    for_each_of(n, [&](int i, int j, int k) {
      const std::array<int, 3> at{i, j, k};
      add_part(grid.face_index(axis, block.first[0] + i, block.first[1] + j, block.first[2] + k),
               row[(static_cast<std::size_t>(at[v]) * n[axis] + at[axis]) * n[along] + at[along]],
               cover.face[axis]);
    });
  }
  return cover;
}

Cover cover_region(const VoxelGrid& grid, const std::function<double(const Vec3&)>& distance) {
  constexpr int kPoints = 8;  // along an edge of a voxel
  /// Fraction of a box that spans `edges` about a point.
  const auto fraction_of = [&](const Vec3& low, const Vec3& edges) {
    const double middle = distance(low + 0.5 * edges), reach = 0.5 * edges.norm();
    if (middle >= reach) return 0.0;
    if (middle <= -reach) return 1.0;
    std::array<int, 3> n{};
    for (int axis = 0; axis < 3; ++axis) n[axis] = edges[axis] > 0 ? kPoints : 1;
    const Vec3 step = edges / kPoints;
    const double size = step.maxCoeff();
    double sum = 0;
    for_each_of(n, [&](int i, int j, int k) {
      const Vec3 x = low + step.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
      sum += std::clamp(0.5 - distance(x) / size, 0.0, 1.0);
    });
    return sum / n[0] / n[1] / n[2];
  };
  const auto corner = [&](int i, int j, int k) {
    return Vec3(grid.low + grid.spacing.cwiseProduct(Vec3(i, j, k)));
  };
  std::vector<Cover> layer(static_cast<std::size_t>(grid.n[2]) + 1);
  for_each_plane(grid.n[2] + 1, grid.n_voxel(), [&](int k) {
    Cover& to = layer[static_cast<std::size_t>(k)];
    for (int j = 0; j <= grid.n[1]; ++j)
      for (int i = 0; i <= grid.n[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        std::array<bool, 3> in{};
        for (int axis = 0; axis < 3; ++axis) in[axis] = at[axis] < grid.n[axis];
        const Vec3 low = corner(i, j, k);
        if (in[0] && in[1] && in[2])
          add_part(grid.index(i, j, k), fraction_of(low, grid.spacing), to.volume);
        for (int axis = 0; axis < 3; ++axis) {
          if (!in[(axis + 1) % 3] || !in[(axis + 2) % 3]) continue;
          Vec3 edges = grid.spacing;
          edges[axis] = 0;
          add_part(grid.face_index(axis, i, j, k), fraction_of(low, edges), to.face[axis]);
        }
      }
  });
  Cover cover;
  for (const Cover& l : layer) {
    cover.volume.insert(cover.volume.end(), l.volume.begin(), l.volume.end());
    for (int axis = 0; axis < 3; ++axis)
      cover.face[axis].insert(cover.face[axis].end(), l.face[axis].begin(), l.face[axis].end());
  }
  return cover;
}

}  // namespace acinus::substances
