#pragma once
/// Capacity of arrays that are kept and change their length little from step to step.

#include <algorithm>
#include <cstddef>

namespace acinus {

/// Least growth, so that short arrays are not moved at every element.
inline constexpr std::size_t kLeastRoom = 8;

/// Ensures capacity for n more elements; where it must grow, by a sixteenth of the length more. An
/// array that is a little longer every step is then seldom moved, which costs as much as writing
/// it. Doubling, as push_back does, would leave half of a step's arrays unused, and these are most
/// of the program's memory.
template <class V>
void make_room(V& v, std::size_t n) {
  const std::size_t all = v.size() + n;
  if (all <= v.capacity()) return;
  if (v.empty()) v = V();  // nothing to move: the old memory is free before the new is taken
  v.reserve(all + std::max(all / 16, kLeastRoom));
}

/// Empties an array that is to be filled with about as many elements again. Where a thirty-second
/// more would not fit, it gets more memory while it is empty: a full array that grows is there
/// twice.
template <class V>
void clear_to_refill(V& v) {
  const std::size_t n = v.size();
  v.clear();
  make_room(v, n + n / 32);
}

/// Resizes v to n elements with this growth of the capacity.
template <class V>
void set_size(V& v, std::size_t n) {
  if (n > v.size()) make_room(v, n - v.size());
  v.resize(n);
}

}  // namespace acinus
