#pragma once
/// Filling and copying of long arrays over all points by all threads.

#include <cstddef>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus {

/// Sets all numbers to zero.
template <class V>
void clear_numbers(V& v) {
  for_each_number(v.size(), [&](std::size_t k) { v[k] = 0; });
}

/// Resizes to n zeros.
template <class V>
void assign_zeros(V& v, std::size_t n) {
  set_size(v, n);
  clear_numbers(v);
}

/// Copies `from` to `to`, which gets the same length.
template <class From, class To>
void copy_numbers(const From& from, To& to) {
  set_size(to, from.size());
  for_each_number(from.size(), [&](std::size_t k) { to[k] = from[k]; });
}

}  // namespace acinus
