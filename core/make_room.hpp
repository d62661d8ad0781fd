#pragma once
/// Memory for arrays that are kept and change their length little from step to step.

#include <algorithm>
#include <cstddef>

namespace acinus {

/// Room for n more elements. What push_back would double grows by an eighth: a step's arrays are
/// most of a program's memory, and half of it would stand empty.
template <class V>
void make_room(V& v, std::size_t n) {
  if (v.capacity() - v.size() < n) v.reserve(v.size() + std::max(n, v.size() / 8));
}

}  // namespace acinus
