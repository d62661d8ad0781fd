#pragma once
/// Memory for arrays that are kept and change their length little from step to step.

#include <cstddef>

namespace acinus {

/// Room for n more elements, and for a sixteenth of all if there was not enough. An array that is
/// a little longer every step must not move every step: that costs as much as what is written to
/// it. What push_back would double: a step's arrays are most of a program's memory, and half of it
/// would stand empty.
template <class V>
void make_room(V& v, std::size_t n) {
  const std::size_t all = v.size() + n;
  if (all > v.capacity()) v.reserve(all + all / 16);
}

/// v.resize(n) that makes room in this way.
template <class V>
void set_size(V& v, std::size_t n) {
  if (n > v.size()) make_room(v, n - v.size());
  v.resize(n);
}

}  // namespace acinus
