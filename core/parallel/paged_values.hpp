#pragma once
/// Values of cells of which most are the same, such as a load on few cells: a page with one value
/// throughout holds it once.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <utility>
#include <vector>

#include "core/parallel/threads.hpp"

namespace acinus {

/// Array of plain values that is read by index and written by set().
template <class T>
class PagedValues {
 public:
  /// Values of a page. Bits are compared, so that 0 and -0 stay what they are.
  static constexpr std::size_t kPage = 256;

  PagedValues() = default;
  explicit PagedValues(const std::vector<T>& values)
      : PagedValues(values.size(), [&](std::size_t k) { return values[k]; }) {}
  /// n values f(k), computed by all threads if they are many.
  template <class F>
  PagedValues(std::size_t n, const F& f) : n_(n), page_((n + kPage - 1) / kPage) {
    for_each_index(page_.size(), worth_threads(n / kPage), [&](std::size_t p) {
      std::vector<T> values;
      for (std::size_t k = p * kPage; k < std::min(n, (p + 1) * kPage); ++k) values.push_back(f(k));
      page_[p] = are_same(values) ? std::vector<T>{values[0]} : std::move(values);
    });
  }

  std::size_t size() const { return n_; }
  bool empty() const { return n_ == 0; }
  void clear() { *this = {}; }
  const T& operator[](std::size_t k) const {
    const std::vector<T>& page = page_[k / kPage];
    return page.size() == 1 ? page[0] : page[k % kPage];
  }
  /// Sets one value. Threads may set values of different pages.
  void set(std::size_t k, const T& value) {
    std::vector<T>& page = page_[k / kPage];
    if (page.size() == 1) {
      if (same(page[0], value)) return;
      page.resize(std::min(kPage, n_ - k / kPage * kPage), T(page[0]));
    }
    page[k % kPage] = value;
  }
  /// Replaces every value v by f(v).
  template <class F>
  void replace(const F& f) {
    *this = PagedValues(n_, [&](std::size_t k) { return T(f((*this)[k])); });
  }

  class Iterator {
   public:
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const PagedValues* values, std::size_t k) : values_(values), k_(k) {}
    const T& operator*() const { return (*values_)[k_]; }
    Iterator& operator++() {
      ++k_;
      return *this;
    }
    Iterator operator++(int) { return {values_, k_++}; }
    bool operator==(const Iterator&) const = default;

   private:
    const PagedValues* values_ = nullptr;
    std::size_t k_ = 0;
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, n_}; }

  /// Memory, bytes.
  std::size_t memory() const {
    std::size_t bytes = page_.capacity() * sizeof(std::vector<T>);
    for (const std::vector<T>& page : page_) bytes += page.capacity() * sizeof(T);
    return bytes;
  }

 private:
  static bool same(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
  static bool are_same(const std::vector<T>& values) {
    return std::ranges::all_of(values, [&](const T& v) { return same(v, values[0]); });
  }
  std::size_t n_ = 0;
  std::vector<std::vector<T>> page_;  ///< of one value for all, or of all
};

}  // namespace acinus
