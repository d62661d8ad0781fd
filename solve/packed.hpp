#pragma once
/// Packed points: the components of a point side by side instead of lanes side by side, for
/// contacts, which join points of any lanes.

#include <array>

#include "core/numbers/lanes.hpp"

namespace acinus::solve {

/// Packed point; the fourth number is unused.
template <class T>
using Packed = std::array<T, 4>;

namespace detail {

template <class T>
struct FourType;
template <>
struct FourType<double> {
  using type = double __attribute__((vector_size(32)));
};
template <>
struct FourType<float> {
  using type = float __attribute__((vector_size(16)));
};

}  // namespace detail

/// Packed point in a register.
template <class T>
using Four = typename detail::FourType<T>::type;

template <class T>
ACINUS_INLINE Four<T> load4(const Packed<T>* p) {
  Four<T> out;
  __builtin_memcpy(&out, p, sizeof(out));
  return out;
}
template <class T>
ACINUS_INLINE void store4(Packed<T>* p, Four<T> v) {
  __builtin_memcpy(p, &v, sizeof(v));
}

/// Converts the eight points of one row from packed to lanes. Spelled out as shuffles: otherwise
/// g++ goes through memory and waits for it.
template <class T>
ACINUS_INLINE Lane3Of<T> load_packed(const Packed<T>* from) {
  auto two = [&](int i) {  // points i and i + 4
    return __builtin_shufflevector(load4(from + i), load4(from + i + 4), 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const LaneOf<T> p0 = two(0), p1 = two(1), p2 = two(2), p3 = two(3);
  const LaneOf<T> xy01 = __builtin_shufflevector(p0, p1, 0, 8, 1, 9, 4, 12, 5, 13);
  const LaneOf<T> xy23 = __builtin_shufflevector(p2, p3, 0, 8, 1, 9, 4, 12, 5, 13);
  const LaneOf<T> z01 = __builtin_shufflevector(p0, p1, 2, 10, 2, 10, 6, 14, 6, 14);
  const LaneOf<T> z23 = __builtin_shufflevector(p2, p3, 2, 10, 2, 10, 6, 14, 6, 14);
  return {__builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(z01, z23, 0, 1, 8, 9, 4, 5, 12, 13)};
}

/// Converts back from lanes to packed points; the fourth number becomes zero.
template <class T>
ACINUS_INLINE void store_packed(Packed<T>* to, const Lane3Of<T>& v) {
  const LaneOf<T> zero = {};
  const LaneOf<T> xy02 = __builtin_shufflevector(v.x, v.y, 0, 8, 1, 9, 4, 12, 5, 13);
  const LaneOf<T> xy13 = __builtin_shufflevector(v.x, v.y, 2, 10, 3, 11, 6, 14, 7, 15);
  const LaneOf<T> zw02 = __builtin_shufflevector(v.z, zero, 0, 8, 1, 9, 4, 12, 5, 13);
  const LaneOf<T> zw13 = __builtin_shufflevector(v.z, zero, 2, 10, 3, 11, 6, 14, 7, 15);
  auto two = [&](int i, LaneOf<T> p) {  // points i and i + 4
    store4<T>(to + i, __builtin_shufflevector(p, p, 0, 1, 2, 3));
    store4<T>(to + i + 4, __builtin_shufflevector(p, p, 4, 5, 6, 7));
  };
  two(0, __builtin_shufflevector(xy02, zw02, 0, 1, 8, 9, 4, 5, 12, 13));
  two(1, __builtin_shufflevector(xy02, zw02, 2, 3, 10, 11, 6, 7, 14, 15));
  two(2, __builtin_shufflevector(xy13, zw13, 0, 1, 8, 9, 4, 5, 12, 13));
  two(3, __builtin_shufflevector(xy13, zw13, 2, 3, 10, 11, 6, 7, 14, 15));
}

}  // namespace acinus::solve
