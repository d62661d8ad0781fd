#pragma once
/// Numbers joined into sets.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace acinus {

/// Numbers [0, n), each in a set of its own until it is joined to others. The lowest number of a
/// set stands for it.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t n) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t size() const { return parent_.size(); }

  /// The number that stands for the set of this one.
  int find(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  bool is_joined(int k) const { return parent_[k] != k; }  ///< to a lower one
  void join(int a, int b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace acinus
