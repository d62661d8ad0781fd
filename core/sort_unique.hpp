#pragma once
/// Sorted set of values in a vector.

#include <algorithm>
#include <vector>

namespace acinus {

/// Sorts values in ascending order and removes repeated ones.
template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values);
  values.erase(repeated.begin(), repeated.end());
}

}  // namespace acinus
