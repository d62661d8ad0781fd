#pragma once
/// Eight cells side by side: a Lane holds one number of each of the eight cells of a group.
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

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ACINUS_KERNEL __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ACINUS_KERNEL
#endif
#define ACINUS_INLINE inline __attribute__((always_inline))

namespace acinus {

using Lane = double __attribute__((vector_size(kLanes * sizeof(double))));

inline constexpr int kPointStride = 3 * kLanes;  ///< doubles per point row
inline constexpr int kSymStride = 6 * kLanes;    ///< doubles per symmetric 3x3 block row
inline constexpr int kMatStride = 9 * kLanes;    ///< doubles per full 3x3 block row

/// Index of a point's x component in a [point][3][lane] array.
using Address = std::uint32_t;
inline Address make_address(std::size_t point_row, int lane) {
  return static_cast<Address>(point_row * kPointStride + static_cast<std::size_t>(lane));
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

ACINUS_INLINE Lane load(const double* p) {
  Lane v;
  __builtin_memcpy(&v, p, sizeof(Lane));
  return v;
}
ACINUS_INLINE void store(double* p, Lane v) { __builtin_memcpy(p, &v, sizeof(Lane)); }
ACINUS_INLINE void add_to(double* p, Lane v) { store(p, load(p) + v); }
ACINUS_INLINE Lane lane_of(double s) { return Lane{s, s, s, s, s, s, s, s}; }
ACINUS_INLINE Lane lane_sqrt(Lane v) {
  Lane r;
  for (int l = 0; l < kLanes; ++l) r[l] = __builtin_sqrt(v[l]);
  return r;
}
ACINUS_INLINE Lane lane_max0(Lane v) { return v > 0.0 ? v : lane_of(0.0); }

/// Three lanes: the same vector quantity of eight cells.
struct Lane3 {
  Lane x, y, z;
};
ACINUS_INLINE Lane3 load3(const double* p) {
  return {load(p), load(p + kLanes), load(p + 2 * kLanes)};
}
ACINUS_INLINE void add3(double* p, const Lane3& v) {
  add_to(p, v.x);
  add_to(p + kLanes, v.y);
  add_to(p + 2 * kLanes, v.z);
}
ACINUS_INLINE Lane3 operator+(const Lane3& a, const Lane3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ACINUS_INLINE Lane3 operator-(const Lane3& a, const Lane3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ACINUS_INLINE Lane3 operator*(Lane s, const Lane3& a) { return {s * a.x, s * a.y, s * a.z}; }
ACINUS_INLINE Lane dot(const Lane3& a, const Lane3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
ACINUS_INLINE Lane3 cross(const Lane3& a, const Lane3& b) {
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
/// Adds s * a b^T to a full block stored row by row.
ACINUS_INLINE void add_outer(double* block, Lane s, const Lane3& a, const Lane3& b) {
  const Lane3 sa = s * a;
  add_to(block, sa.x * b.x);
  add_to(block + kLanes, sa.x * b.y);
  add_to(block + 2 * kLanes, sa.x * b.z);
  add_to(block + 3 * kLanes, sa.y * b.x);
  add_to(block + 4 * kLanes, sa.y * b.y);
  add_to(block + 5 * kLanes, sa.y * b.z);
  add_to(block + 6 * kLanes, sa.z * b.x);
  add_to(block + 7 * kLanes, sa.z * b.y);
  add_to(block + 8 * kLanes, sa.z * b.z);
}
/// Adds s * I to a symmetric block.
ACINUS_INLINE void add_identity_sym(double* block, Lane s) {
  add_to(block, s);
  add_to(block + 3 * kLanes, s);
  add_to(block + 5 * kLanes, s);
}

}  // namespace acinus
