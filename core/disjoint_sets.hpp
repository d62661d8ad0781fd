#pragma once
/// Union-find over the numbers [0, n).

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <vector>

namespace acinus {

/// Disjoint sets of the numbers [0, n), each at first in a set of its own. The representative of a
/// set is its lowest number, so the result does not depend on the order of joins: threads may join
/// at the same time.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t n) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t size() const { return parent_.size(); }

  /// Representative of the set that contains k: the lowest number in it.
  int find(int k) {
    for (int up = parent(k).load(kRelaxed); up != k;) {
      // Whatever others do meanwhile, a parent is only ever replaced by one further up.
      const int above = parent(up).load(kRelaxed);
      if (above != up) parent(k).store(above, kRelaxed);
      k = up;
      up = above;
    }
    return k;
  }
  bool is_joined(int k) const {
    return parent_[k] != k;
  }  ///< true if k has been joined to a lower number
  void join(int a, int b) {
    for (;;) {
      auto [low, high] = std::minmax({find(a), find(b)});
      if (low == high) return;
      // Another thread may have put the higher one below something else since.
      if (parent(high).compare_exchange_strong(high, low, kRelaxed)) return;
    }
  }

 private:
  static constexpr std::memory_order kRelaxed = std::memory_order_relaxed;
  std::atomic_ref<int> parent(int k) { return std::atomic_ref(parent_[k]); }
  std::vector<int> parent_;
};

}  // namespace acinus
