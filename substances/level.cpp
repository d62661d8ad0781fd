#include "substances/level.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Neighbours of a row across y and z, with the conductances to them per width along x.
template <class T>
struct NeighbourRows {
  const T* below_y;
  const T* above_y;
  const T* below_z;
  const T* above_z;
  T y_low, y_high, z_low, z_high;
  T area_x;  ///< of faces across x
};

template <class T>
NeighbourRows<T> row_at(const Level<T>& l, const T* x, int j, int k) {
  const PaddedLayout& at = l.layout;
  const auto plane = static_cast<std::size_t>(at.n[1]) * at.stride;
  const T* own = x + at.row(j, k);
  const double wy = l.width[1][j], wz = l.width[2][k];
  return {j > 0 ? own - at.stride : own,
          j + 1 < at.n[1] ? own + at.stride : own,
          k > 0 ? own - plane : own,
          k + 1 < at.n[2] ? own + plane : own,
          static_cast<T>(l.face[1][j] * wz),
          static_cast<T>(l.face[1][j + 1] * wz),
          static_cast<T>(l.face[2][k] * wy),
          static_cast<T>(l.face[2][k + 1] * wy),
          static_cast<T>(wy * wz)};
}

template <class T>
ACINUS_INLINE LaneOf<T> spread(T s) {
  return LaneOf<T>{s, s, s, s, s, s, s, s};
}

/// Neighbours of eight voxels along their row.
template <class T>
struct Beside {
  LaneOf<T> left, right;
};

template <class T>
ACINUS_INLINE Beside<T> load_beside(const T* x) {
  return {load<T>(x - 1), load<T>(x + 1)};
}

/// Flow into eight voxels from their neighbours.
template <class T>
ACINUS_INLINE LaneOf<T> inflow(const T* low, const T* high, const T* width,
                               const NeighbourRows<T>& r, const Beside<T>& x, std::size_t i) {
  const LaneOf<T> along = load<T>(low + i) * x.left + load<T>(high + i) * x.right;
  const LaneOf<T> across =
      spread(r.y_low) * load<T>(r.below_y + i) + spread(r.y_high) * load<T>(r.above_y + i) +
      spread(r.z_low) * load<T>(r.below_z + i) + spread(r.z_high) * load<T>(r.above_z + i);
  return spread(r.area_x) * along + load<T>(width + i) * across;
}

/// The same with a conductance per face.
template <class T>
struct PartialRows {
  const T* below_y;
  const T* above_y;
  const T* below_z;
  const T* above_z;
  const T* x;  ///< conductances to the voxels before
  const T* y_low;
  const T* y_high;
  const T* z_low;
  const T* z_high;
};

template <class T>
PartialRows<T> partial_row_at(const Level<T>& l, const T* x, int j, int k) {
  const PaddedLayout& at = l.layout;
  const std::size_t row = at.row(j, k), plane = static_cast<std::size_t>(at.n[1]) * at.stride;
  const T *own = x + row, *y = l.partial[1].data() + row, *z = l.partial[2].data() + row;
  const bool last_y = j + 1 == at.n[1], last_z = k + 1 == at.n[2];
  return {j > 0 ? own - at.stride : own,
          last_y ? own : own + at.stride,
          k > 0 ? own - plane : own,
          last_z ? own : own + plane,
          l.partial[0].data() + row,
          y,
          last_y ? l.no_faces.data() : y + at.stride,
          z,
          last_z ? l.no_faces.data() : z + plane};
}

template <class T>
ACINUS_INLINE LaneOf<T> inflow(const T*, const T*, const T*, const PartialRows<T>& r,
                               const Beside<T>& x, std::size_t i) {
  const LaneOf<T> along = load<T>(r.x + i) * x.left + load<T>(r.x + i + 1) * x.right;
  const LaneOf<T> in_plane = load<T>(r.y_low + i) * load<T>(r.below_y + i) +
                             load<T>(r.y_high + i) * load<T>(r.above_y + i);
  const LaneOf<T> across = load<T>(r.z_low + i) * load<T>(r.below_z + i) +
                           load<T>(r.z_high + i) * load<T>(r.above_z + i);
  return along + in_plane + across;
}

/// Calls f(rows beside row j, k), of either kind.
template <class T, class F>
auto with_rows(const Level<T>& l, const T* x, int j, int k, const F& f) {
  return l.has_obstacles() ? f(partial_row_at(l, x, j, k)) : f(row_at(l, x, j, k));
}

template <class T>
using MaskOf =
    std::conditional_t<std::is_same_v<T, float>,
                       std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t)))),
                       std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))))>;

template <class T>
struct LevelRow {
  std::size_t n;  ///< numbers, whole lanes
  const T* low;
  const T* high;
  const T* width;
};

template <class T>
LevelRow<T> level_row(const Level<T>& l) {
  return {l.layout.stride - kLanes, l.face_low.data(), l.face_high.data(), l.width_x.data()};
}

// By value: stores to x could change what a reference names, and it would be read again each time.

/// Solves for the voxels of a row whose number along x has this parity.
template <class T, class Rows>
ACINUS_INLINE void smooth_row_of(LevelRow<T> l, Rows r, const T* inverse, const T* b, bool odd,
                                 T* x) {
  const MaskOf<T> mask =
      odd ? MaskOf<T>{0, -1, 0, -1, 0, -1, 0, -1} : MaskOf<T>{-1, 0, -1, 0, -1, 0, -1, 0};
  // Neighbours come from registers: a load across what was just stored would wait for the store.
  LaneOf<T> before = load<T>(x - kLanes), here = load<T>(x);
  for (std::size_t i = 0; i < l.n; i += kLanes) {
    const LaneOf<T> after = load<T>(x + i + kLanes);
    const Beside<T> beside{__builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14),
                           __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8)};
    const LaneOf<T> value =
        load<T>(inverse + i) * (load<T>(b + i) + inflow(l.low, l.high, l.width, r, beside, i));
    store(x + i, mask ? value : here);
    before = here;
    here = after;
  }
}
template <class T>
ACINUS_INLINE void start_row_of(std::size_t n, const T* inverse, const T* b, bool odd, T* x) {
  const MaskOf<T> mask =
      odd ? MaskOf<T>{0, -1, 0, -1, 0, -1, 0, -1} : MaskOf<T>{-1, 0, -1, 0, -1, 0, -1, 0};
  const LaneOf<T> zero = spread(T{0});
  for (std::size_t i = 0; i < n; i += kLanes)
    store(x + i, mask ? load<T>(inverse + i) * load<T>(b + i) : zero);
}
template <class T, class Rows>
ACINUS_INLINE double multiply_row_of(LevelRow<T> l, Rows r, const T* diagonal, const T* x, T* y) {
  Lane sum = lane_of(0);
  for (std::size_t i = 0; i < l.n; i += kLanes) {
    const LaneOf<T> own = load<T>(x + i);
    const LaneOf<T> value =
        load<T>(diagonal + i) * own - inflow(l.low, l.high, l.width, r, load_beside(x + i), i);
    store(y + i, value);
    sum += __builtin_convertvector(own, Lane) * __builtin_convertvector(value, Lane);
  }
  return sum_lanes<double>(sum);
}
template <class T, class Rows>
ACINUS_INLINE void residual_row_of(LevelRow<T> l, Rows r, const T* diagonal, const T* b, const T* x,
                                   T* y) {
  for (std::size_t i = 0; i < l.n; i += kLanes)
    store(y + i, load<T>(b + i) - load<T>(diagonal + i) * load<T>(x + i) +
                     inflow(l.low, l.high, l.width, r, load_beside(x + i), i));
}

ACINUS_KERNEL void smooth_row(const LevelRow<float>& l, const NeighbourRows<float>& r,
                              const float* inverse, const float* b, bool odd, float* x) {
  smooth_row_of(l, r, inverse, b, odd, x);
}
ACINUS_KERNEL double multiply_row(const LevelRow<double>& l, const NeighbourRows<double>& r,
                                  const double* diagonal, const double* x, double* y) {
  return multiply_row_of(l, r, diagonal, x, y);
}
ACINUS_KERNEL void residual_row(const LevelRow<float>& l, const NeighbourRows<float>& r,
                                const float* diagonal, const float* b, const float* x, float* y) {
  residual_row_of(l, r, diagonal, b, x, y);
}
ACINUS_KERNEL void residual_row(const LevelRow<double>& l, const NeighbourRows<double>& r,
                                const double* diagonal, const double* b, const double* x,
                                double* y) {
  residual_row_of(l, r, diagonal, b, x, y);
}
ACINUS_KERNEL void smooth_row(const LevelRow<float>& l, const PartialRows<float>& r,
                              const float* inverse, const float* b, bool odd, float* x) {
  smooth_row_of(l, r, inverse, b, odd, x);
}
ACINUS_KERNEL double multiply_row(const LevelRow<double>& l, const PartialRows<double>& r,
                                  const double* diagonal, const double* x, double* y) {
  return multiply_row_of(l, r, diagonal, x, y);
}
ACINUS_KERNEL void residual_row(const LevelRow<float>& l, const PartialRows<float>& r,
                                const float* diagonal, const float* b, const float* x, float* y) {
  residual_row_of(l, r, diagonal, b, x, y);
}
ACINUS_KERNEL void residual_row(const LevelRow<double>& l, const PartialRows<double>& r,
                                const double* diagonal, const double* b, const double* x,
                                double* y) {
  residual_row_of(l, r, diagonal, b, x, y);
}
ACINUS_KERNEL void start_row(std::size_t n, const float* inverse, const float* b, bool odd,
                             float* x) {
  start_row_of(n, inverse, b, odd, x);
}

/// Updates the voxels of one colour in plane k. Colour 0: i + j + k even.
void smooth_plane(const Level<float>& l, const float* b, float* x, int k, int colour,
                  bool from_zero) {
  const LevelRow<float> row = level_row(l);
  for (int j = 0; j < l.layout.n[1]; ++j) {
    const std::size_t at = l.layout.row(j, k);
    const bool odd = ((j + k + colour) & 1) != 0;
    if (from_zero)
      start_row(row.n, l.inverse.data() + at, b + at, odd, x + at);
    else
      with_rows(l, static_cast<const float*>(x), j, k, [&](const auto& rows) {
        smooth_row(row, rows, l.inverse.data() + at, b + at, odd, x + at);
      });
  }
}

}  // namespace

double multiply_plane(const Level<double>& l, const double* x, double* y, int k) {
  const LevelRow<double> row = level_row(l);
  double sum = 0;
  for (int j = 0; j < l.layout.n[1]; ++j) {
    const std::size_t at = l.layout.row(j, k);
    sum += with_rows(l, x, j, k, [&](const auto& rows) {
      return multiply_row(row, rows, l.diagonal.data() + at, x + at, y + at);
    });
  }
  return sum;
}

double multiply(const Level<double>& l, const double* x, double* y) {
  return sum_planes(l.layout.n[2], l.layout.n_voxel(),
                    [&](int k) { return multiply_plane(l, x, y, k); });
}

void smooth(const Level<float>& l, const float* b, float* x, bool forward, bool from_zero) {
  const int n = l.layout.n[2], first = forward ? 0 : 1, second = 1 - first;
  const std::size_t n_voxel = l.layout.n_voxel();
  if (thread_count() > 1 && n_voxel > kParallelVoxels) {
    // Planes apart at a time: a row is written whole, and others read its second colour.
    for (const int colour : {first, second})
      for (const int start : {0, 1})
        for_each_plane((n - start + 1) / 2, n_voxel, [&](int k) {
          smooth_plane(l, b, x, 2 * k + start, colour, from_zero && colour == first);
        });
    return;
  }
  // The second colour follows one plane behind, while its neighbours are in the cache.
  for (int k = 0; k < n; ++k) {
    smooth_plane(l, b, x, k, first, from_zero);
    if (k > 0) smooth_plane(l, b, x, k - 1, second, false);
  }
  smooth_plane(l, b, x, n - 1, second, false);
}

template <class T>
void subtract_product(const Level<T>& l, const T* b, const T* x, T* r) {
  const LevelRow<T> row = level_row(l);
  for_each_plane(l.layout.n[2], l.layout.n_voxel(), [&](int k) {
    for (int j = 0; j < l.layout.n[1]; ++j) {
      const std::size_t at = l.layout.row(j, k);
      with_rows(l, x, j, k, [&](const auto& rows) {
        residual_row(row, rows, l.diagonal.data() + at, b + at, x + at, r + at);
      });
    }
  });
}

template void subtract_product(const Level<float>&, const float*, const float*, float*);
template void subtract_product(const Level<double>&, const double*, const double*, double*);

}  // namespace acinus::substances
