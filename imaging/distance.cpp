#include "imaging/distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace acinus::imaging {
namespace {

constexpr double kNoneFound = 1e30;  // um^2, before any voxel of the kind was met

/// Calls visit(first, stride, n) for every line of a grid along an axis.
template <class Visit>
void for_each_line(const Grid& g, int axis, Visit visit) {
  const std::size_t n_x = g.size[0], n_y = g.size[1];
  const std::array<std::size_t, 3> stride{1, n_x, n_x * n_y};
  const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  for (int j = 0; j < g.size[v]; ++j)
    for (int i = 0; i < g.size[u]; ++i)
      visit(i * stride[u] + j * stride[v], stride[axis], g.size[axis]);
}

/// Squared distances along one line: the lower envelope of parabolas on the squared distances found
/// along the previous axes.
class Envelope {
 public:
  void run(std::vector<double>& f, std::size_t first, std::size_t stride, std::size_t n,
           double step) {
    height_.resize(n);
    for (std::size_t k = 0; k < n; ++k) height_[k] = f[first + k * stride];
    foot_.clear();
    begin_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if (height_[k] >= kNoneFound) continue;
      double meets = -std::numeric_limits<double>::infinity();
      while (!foot_.empty()) {
        meets = crossing(foot_.back(), k, step);
        if (meets > begin_.back()) break;
        foot_.pop_back();
        begin_.pop_back();
        meets = -std::numeric_limits<double>::infinity();
      }
      foot_.push_back(k);
      begin_.push_back(meets);
    }
    if (foot_.empty()) return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = step * static_cast<double>(k);
      while (at + 1 < foot_.size() && begin_[at + 1] <= x) ++at;
      const double apart = x - step * static_cast<double>(foot_[at]);
      f[first + k * stride] = apart * apart + height_[foot_[at]];
    }
  }

 private:
  /// Position at which the parabola on the later foot q falls below that on p, um.
  double crossing(std::size_t p, std::size_t q, double step) const {
    const double a = step * static_cast<double>(p), b = step * static_cast<double>(q);
    return ((height_[q] + b * b) - (height_[p] + a * a)) / (2 * (b - a));
  }
  std::vector<double> height_, begin_;
  std::vector<std::size_t> foot_;
};

/// Distances from the nearest voxel of a kind, um.
std::vector<double> distances_to(const std::vector<std::uint8_t>& inside, bool kind,
                                 const Grid& grid) {
  std::vector<double> f(inside.size());
  for (std::size_t k = 0; k < f.size(); ++k) f[k] = (inside[k] != 0) == kind ? 0 : kNoneFound;
  Envelope envelope;
  for (int axis = 0; axis < 3; ++axis)
    for_each_line(grid, axis, [&](std::size_t first, std::size_t stride, std::size_t n) {
      envelope.run(f, first, stride, n, grid.voxel[axis]);
    });
  for (double& d : f) d = std::sqrt(d);
  return f;
}

}  // namespace

double Grid::at(const Vec3& x) const {
  std::array<int, 3> low{};
  Vec3 part;
  for (int k = 0; k < 3; ++k) {
    const double u =
        std::clamp((x[k] - origin[k]) / voxel[k], 0.0, static_cast<double>(size[k] - 1));
    low[k] = std::min(static_cast<int>(u), std::max(size[k] - 2, 0));
    part[k] = u - low[k];
  }
  const auto value_at = [&](int i, int j, int k) {
    return value[index({std::min(low[0] + i, size[0] - 1), std::min(low[1] + j, size[1] - 1),
                        std::min(low[2] + k, size[2] - 1)})];
  };
  const auto along_x = [&](int j, int k) {
    return (1 - part[0]) * value_at(0, j, k) + part[0] * value_at(1, j, k);
  };
  const auto along_xy = [&](int k) {
    return (1 - part[1]) * along_x(0, k) + part[1] * along_x(1, k);
  };
  return (1 - part[2]) * along_xy(0) + part[2] * along_xy(1);
}

void compute_signed_distance(const std::vector<std::uint8_t>& inside, Grid& grid) {
  const std::vector<double> to_inside = distances_to(inside, true, grid),
                            to_outside = distances_to(inside, false, grid);
  grid.value.resize(inside.size());
  for (std::size_t k = 0; k < inside.size(); ++k)
    grid.value[k] = inside[k] != 0 ? -to_outside[k] : to_inside[k];
}

void smooth(const Vec3& voxels, Grid& grid) {
  constexpr double kCut = 3, kLeast = 0.05;  // standard deviations; below which nothing is done
  std::vector<double> weight, line;
  for (int axis = 0; axis < 3; ++axis) {
    if (voxels[axis] < kLeast) continue;
    const int reach = static_cast<int>(std::ceil(kCut * voxels[axis]));
    weight.clear();
    double sum = 0;
    for (int k = -reach; k <= reach; ++k)
      sum += weight.emplace_back(std::exp(-0.5 * k * k / (voxels[axis] * voxels[axis])));
    for (double& w : weight) w /= sum;
    for_each_line(grid, axis, [&](std::size_t first, std::size_t stride, std::size_t n) {
      const int last = static_cast<int>(n) - 1;
      line.resize(n);
      for (std::size_t k = 0; k < n; ++k) line[k] = grid.value[first + k * stride];
      for (int k = 0; k <= last; ++k) {
        double mean = 0;
        for (int j = -reach; j <= reach; ++j)
          mean += weight[j + reach] * line[std::clamp(k + j, 0, last)];
        grid.value[first + k * stride] = mean;
      }
    });
  }
}

double compute_largest_slope(const Grid& grid) {
  Vec3 most = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for_each_line(grid, axis, [&](std::size_t first, std::size_t stride, std::size_t n) {
      for (std::size_t k = 0; k + 1 < n; ++k)
        most[axis] = std::max(most[axis], std::abs(grid.value[first + (k + 1) * stride] -
                                                   grid.value[first + k * stride]) /
                                              grid.voxel[axis]);
    });
  return most.norm();
}

}  // namespace acinus::imaging
