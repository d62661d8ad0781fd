/// Matrix of a level: conductances of faces, diagonal.

#include <algorithm>
#include <type_traits>

#include "substances/level.hpp"
#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Only levels in single precision are smoothed.
template <class T>
constexpr bool kSmooths = std::is_same_v<T, float>;

/// Sum of the conductances of the faces of the voxel in row j, k at a place.
template <class T>
double sum_partial_faces(const Level<T>& l, std::size_t at, int j, int k) {
  const std::array<int, 3>& n = l.layout.n;
  const std::size_t plane = static_cast<std::size_t>(n[1]) * l.layout.stride;
  const std::vector<T>&x = l.partial[0], &y = l.partial[1], &z = l.partial[2];
  return static_cast<double>(x[at]) + x[at + 1] + y[at] +
         (j + 1 < n[1] ? y[at + l.layout.stride] : T{0}) + z[at] +
         (k + 1 < n[2] ? z[at + plane] : T{0});
}

}  // namespace

PaddedLayout make_layout(const std::array<int, 3>& n) {
  PaddedLayout layout;
  layout.n = n;
  const auto lanes = static_cast<std::size_t>((n[0] + kLanes - 1) / kLanes);
  layout.stride = kLanes * (lanes + 1);
  layout.size = layout.row(0, n[2]) + kLanes;
  return layout;
}

template <class T>
void set_faces(const std::array<double, 3>& conductance, Level<T>& l) {
  for (int axis = 0; axis < 3; ++axis) {
    l.partial[axis].clear();
    const std::vector<double>& width = l.width[axis];
    l.face[axis].assign(width.size() + 1, 0.0);
    for (std::size_t i = 1; i < width.size(); ++i)
      l.face[axis][i] = conductance[axis] * 2 / (width[i - 1] + width[i]);
  }
  l.face_low.assign(l.layout.stride, T{0});
  l.face_high.assign(l.layout.stride, T{0});
  l.width_x.assign(l.layout.stride, T{0});
  for (std::size_t i = 0; i < l.width[0].size(); ++i) {
    l.face_low[i] = static_cast<T>(l.face[0][i]);
    l.face_high[i] = static_cast<T>(l.face[0][i + 1]);
    l.width_x[i] = static_cast<T>(l.width[0][i]);
  }
}

template <class T>
void set_partial_faces(const std::array<double, 3>& conductance,
                       const std::array<std::vector<double>, 3>& open, Level<T>& l) {
  const std::array<int, 3>& n = l.layout.n;
  l.no_faces.assign(l.layout.stride, T{0});
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<T>& to = l.partial[axis];
    to.assign(l.layout.size, T{0});
    const std::array<int, 3> more{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
    for_each_plane(n[2], l.layout.n_voxel(), [&](int k) {
      for (int j = 0; j < n[1]; ++j) {
        const double* from =
            open[axis].data() + (static_cast<std::size_t>(k) * (n[1] + more[1]) + j) *
                                    static_cast<std::size_t>(n[0] + more[0]);
        const std::size_t row = l.layout.row(j, k);
        for (int i = 0; i < n[0]; ++i) {
          const bool at_end = (axis == 0 ? i : axis == 1 ? j : k) == 0;
          to[row + i] = at_end ? T{0} : static_cast<T>(conductance[axis] * from[i]);
        }
      }
    });
  }
}

template <class T>
void set_diagonal(std::span<const double> all, Level<T>& l) {
  const PaddedLayout& at = l.layout;
  if (l.diagonal.size() != at.size) {
    l.diagonal.assign(at.size, T{0});
    if (kSmooths<T>) l.inverse.assign(at.size, T{0});
  }
  const auto set = [&](std::size_t voxel, double sum) {
    l.diagonal[voxel] = static_cast<T>(sum);
    if constexpr (kSmooths<T>) l.inverse[voxel] = sum > 0 ? static_cast<T>(1 / sum) : T{0};
  };
  for_each_plane(at.n[2], at.n_voxel(), [&](int k) {
    for (int j = 0; j < at.n[1]; ++j) {
      const double wy = l.width[1][j], wz = l.width[2][k];
      const double of_y = (l.face[1][j] + l.face[1][j + 1]) * wz;
      const double of_z = (l.face[2][k] + l.face[2][k + 1]) * wy;
      const std::size_t row = at.row(j, k);
      const double* own = all.data() + static_cast<std::size_t>(at.n[0]) *
                                           (static_cast<std::size_t>(k) * at.n[1] + j);
      if (l.has_obstacles()) {
        for (int i = 0; i < at.n[0]; ++i)
          set(row + i, own[i] + sum_partial_faces(l, row + static_cast<std::size_t>(i), j, k));
        continue;
      }
      for (int i = 0; i < at.n[0]; ++i) {
        const double of_x = (l.face[0][i] + l.face[0][i + 1]) * wy * wz;
        set(row + i, own[i] + of_x + l.width[0][i] * (of_y + of_z));
      }
    }
  });
}

template void set_faces(const std::array<double, 3>&, Level<float>&);
template void set_faces(const std::array<double, 3>&, Level<double>&);
template void set_partial_faces(const std::array<double, 3>&,
                                const std::array<std::vector<double>, 3>&, Level<float>&);
template void set_partial_faces(const std::array<double, 3>&,
                                const std::array<std::vector<double>, 3>&, Level<double>&);
template void set_diagonal(std::span<const double>, Level<float>&);
template void set_diagonal(std::span<const double>, Level<double>&);

}  // namespace acinus::substances
