#pragma once
/// Array that is made part by part while it is written.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace acinus::io {

/// Takes consecutive values.
template <class T>
using TakePart = std::function<void(std::span<const T>)>;

template <class T>
struct ArraySource {
  std::size_t size = 0;
  /// Hands over all `size` values in consecutive parts. Asked for once.
  std::function<void(const TakePart<T>&)> visit;
};

/// Values that are collected up to 2 MB before they are handed over.
template <class T>
class PartBuffer {
 public:
  explicit PartBuffer(const TakePart<T>& take) : take_(take) {}
  /// Values that wait, to be appended to; hand_over_full() follows.
  std::vector<T>& values() { return values_; }
  void put(std::span<const T> values) {
    values_.insert(values_.end(), values.begin(), values.end());
    hand_over_full();
  }
  void hand_over_full() {
    if (values_.size() * sizeof(T) >= kMostBytes) hand_over();
  }
  void hand_over() {
    if (!values_.empty()) take_(values_);
    values_.clear();
  }

 private:
  static constexpr std::size_t kMostBytes = 2 << 20;
  const TakePart<T>& take_;
  std::vector<T> values_;
};

}  // namespace acinus::io
