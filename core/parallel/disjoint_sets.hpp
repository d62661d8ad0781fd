#pragma once
/// Union-find over the numbers [0, n).

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>

#include "core/parallel/row_vector.hpp"

namespace acinus {

/// Disjoint sets of the numbers [0, n), each at first in a set of its own. The representative of a
/// set is its lowest number, so the result does not depend on the order of joins: threads may join
/// at the same time.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t n) { reset(n); }

  void reset(std::size_t n) {
    set_size(n);
    separate(0, n);
  }
  /// Makes room for n numbers; only those that separate() was called for may be used.
  void set_size(std::size_t n) { acinus::set_size(parent_, n); }
  /// Puts each of the numbers [first, last) in a set of its own.
  void separate(std::size_t first, std::size_t last) {
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(first),
              parent_.begin() + static_cast<std::ptrdiff_t>(last), static_cast<int>(first));
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
  RowVector<int> parent_;  ///< those that are not used have no memory
};

}  // namespace acinus
