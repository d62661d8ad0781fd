#pragma once
/// Lanes: the vectors of eight numbers, one for each of the eight cells of a group.
///
/// Layout of every per-point array: [point][component][lane]. A point's address is the index of its
/// x component; y and z follow at +kLanes and +2 kLanes. Kernels marked ACINUS_KERNEL are compiled
/// for AVX-512, AVX2 and baseline x86-64 and picked at run time; lane arithmetic gives the same
/// bits on each.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/vec.hpp"

// Clang passes no vectors between functions compiled for different processors.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define ACINUS_KERNEL __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ACINUS_KERNEL
#endif
#define ACINUS_INLINE inline __attribute__((always_inline))

namespace acinus {

/// Vector of eight numbers: double for forces and positions, float inside the iterations of the
/// solver.
template <class T>
struct LaneType;
template <>
struct LaneType<double> {
  using type = double __attribute__((vector_size(kLanes * sizeof(double))));
};
template <>
struct LaneType<float> {
  using type = float __attribute__((vector_size(kLanes * sizeof(float))));
};
template <class T>
using LaneOf = typename LaneType<T>::type;
using Lane = LaneOf<double>;

inline constexpr int kPointStride = 3 * kLanes;  ///< doubles per point row
inline constexpr int kSymStride = 6 * kLanes;    ///< numbers per symmetric 3x3 block row

/// Index of a point's x component in a [point][3][lane] array.
using Address = std::uint32_t;
inline Address make_address(std::size_t point_row, int lane) {
  return static_cast<Address>(point_row * kPointStride + lane);
}

inline Vec3 load_point(const double* array, Address address) {
  return {array[address], array[address + kLanes], array[address + 2 * kLanes]};
}
inline void store_point(double* array, Address address, const Vec3& value) {
  array[address] = value.x();
  array[address + kLanes] = value.y();
  array[address + 2 * kLanes] = value.z();
}
inline void add_point(double* array, Address address, const Vec3& value) {
  array[address] += value.x();
  array[address + kLanes] += value.y();
  array[address + 2 * kLanes] += value.z();
}

/// Loads eight numbers. T is the number type of the result; the array may hold the other type.
template <class T = double, class From>
ACINUS_INLINE LaneOf<T> load(const From* p) {
  LaneOf<From> v;
  __builtin_memcpy(&v, p, sizeof(v));
  return __builtin_convertvector(v, LaneOf<T>);
}
/// Stores eight numbers, rounded if the array holds floats.
template <class To, class V>
ACINUS_INLINE void store(To* p, V v) {
  const LaneOf<To> out = __builtin_convertvector(v, LaneOf<To>);
  __builtin_memcpy(p, &out, sizeof(out));
}
template <class T>
ACINUS_INLINE void add_to(T* p, LaneOf<T> v) {
  store(p, load<T>(p) + v);
}
ACINUS_INLINE Lane lane_of(double s) { return Lane{s, s, s, s, s, s, s, s}; }
ACINUS_INLINE Lane lane_sqrt(Lane v) {
  Lane r;
  for (int l = 0; l < kLanes; ++l) r[l] = __builtin_sqrt(v[l]);
  return r;
}
ACINUS_INLINE Lane lane_max0(Lane v) { return v > 0.0 ? v : lane_of(0.0); }
/// Sum over the lanes, in lane order.
template <class T>
ACINUS_INLINE double sum_lanes(LaneOf<T> v) {
  double sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += static_cast<double>(v[l]);
  return sum;
}

/// Vector quantity of eight cells, as three lanes.
template <class T>
struct Lane3Of {
  LaneOf<T> x, y, z;
};
using Lane3 = Lane3Of<double>;

template <class T = double, class From>
ACINUS_INLINE Lane3Of<T> load3(const From* p) {
  return {load<T>(p), load<T>(p + kLanes), load<T>(p + 2 * kLanes)};
}
template <class To, class T>
ACINUS_INLINE void store3(To* p, const Lane3Of<T>& v) {
  store(p, v.x);
  store(p + kLanes, v.y);
  store(p + 2 * kLanes, v.z);
}
template <class T>
ACINUS_INLINE void add3(T* p, const Lane3Of<T>& v) {
  add_to(p, v.x);
  add_to(p + kLanes, v.y);
  add_to(p + 2 * kLanes, v.z);
}
template <class T>
ACINUS_INLINE Lane3Of<T> operator+(const Lane3Of<T>& a, const Lane3Of<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
ACINUS_INLINE Lane3Of<T> operator-(const Lane3Of<T>& a, const Lane3Of<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
ACINUS_INLINE Lane3Of<T> operator-(const Lane3Of<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
ACINUS_INLINE Lane3Of<T> operator*(LaneOf<T> s, const Lane3Of<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
ACINUS_INLINE LaneOf<T> dot(const Lane3Of<T>& a, const Lane3Of<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
ACINUS_INLINE Lane3Of<T> cross(const Lane3Of<T>& a, const Lane3Of<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Adds s * a a^T to a symmetric block stored as xx, xy, xz, yy, yz, zz.
ACINUS_INLINE void add_outer_sym(double* block, Lane s, const Lane3& a) {
  const Lane3 sa = s * a;
  add_to(block, sa.x * a.x);
  add_to(block + kLanes, sa.x * a.y);
  add_to(block + 2 * kLanes, sa.x * a.z);
  add_to(block + 3 * kLanes, sa.y * a.y);
  add_to(block + 4 * kLanes, sa.y * a.z);
  add_to(block + 5 * kLanes, sa.z * a.z);
}
/// Adds s * I to a symmetric block.
ACINUS_INLINE void add_identity_sym(double* block, Lane s) {
  add_to(block, s);
  add_to(block + 3 * kLanes, s);
  add_to(block + 5 * kLanes, s);
}

}  // namespace acinus
