#pragma once
/// Vectors with numbers for all rows of a system. A process writes those of its own cells and of
/// near ones only; pages that are never written have addresses and no memory.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/pages.hpp"

namespace acinus {

template <class T>
using RowVector = std::vector<T, MappingAllocator<T, (std::size_t{1} << 16)>>;

/// Resizes to n numbers, with room for a sixteenth more. Numbers that were there are lost if the
/// vector moves, and new ones have no value, so that nothing is written.
template <class T>
void set_size(RowVector<T>& v, std::size_t n) {
  if (n > v.capacity()) {
    v = RowVector<T>();
    v.reserve(n + n / 16);
  }
  v.resize(n);
}

/// Returns the memory of all numbers of a large vector; they have no value then.
template <class T>
void release_rows(RowVector<T>& v) {
  if (v.get_allocator().is_mapped(v.capacity())) release_pages(v.data(), v.capacity() * sizeof(T));
}

/// n zeros; those of a large vector have no memory until they are written.
template <class T>
RowVector<T> make_zeros(std::size_t n) {
  RowVector<T> v(n);  // new pages are zero
  if (!v.get_allocator().is_mapped(v.capacity())) v.assign(n, T{});
  return v;
}

/// Row vector that is part of a state. Where the original has zeros its copy has no memory either.
template <class T>
class HeldRows : public RowVector<T> {
 public:
  HeldRows() = default;
  HeldRows(RowVector<T>&& rows) : RowVector<T>(std::move(rows)) {}  // NOLINT: it is such a vector
  explicit HeldRows(std::span<const T> values) : RowVector<T>(values.begin(), values.end()) {}
  HeldRows(HeldRows&&) noexcept = default;
  HeldRows& operator=(HeldRows&&) noexcept = default;
  HeldRows(const HeldRows& o) : RowVector<T>(make_zeros<T>(o.size())) {
    o.for_each_written([&](std::size_t k, std::size_t n) {
      std::memcpy(this->data() + k, o.data() + k, n * sizeof(T));
    });
  }
  HeldRows& operator=(const HeldRows& o) {
    if (this == &o) return *this;
    if (this->size() != o.size()) return *this = HeldRows(o);
    for_each_run([&](std::size_t k, std::size_t n) {  // equal pages are not written
      if (std::memcmp(this->data() + k, o.data() + k, n * sizeof(T)) != 0)
        std::memcpy(this->data() + k, o.data() + k, n * sizeof(T));
    });
    return *this;
  }
  ~HeldRows() = default;

  /// Resizes as any vector does: unlike set_size() it gives new numbers a value.
  void resize(std::size_t n, const T& value = T{}) { RowVector<T>::resize(n, value); }

  /// Calls f(k, n) for the runs [k, k + n) of a page that are not all zero.
  template <class F>
  void for_each_written(const F& f) const {
    constexpr std::array<std::byte, kRun * sizeof(T)> kZeros{};
    for_each_run([&](std::size_t k, std::size_t n) {
      if (std::memcmp(this->data() + k, kZeros.data(), n * sizeof(T)) != 0) f(k, n);
    });
  }

 private:
  static constexpr std::size_t kRun = 4096 / sizeof(T);  ///< numbers of a page
  template <class F>
  void for_each_run(const F& f) const {
    for (std::size_t k = 0; k < this->size(); k += kRun) f(k, std::min(kRun, this->size() - k));
  }
};

/// Memory that a vector has, bytes.
template <class T>
std::size_t memory_of(const RowVector<T>& v) {
  const std::size_t bytes = v.capacity() * sizeof(T);
  return v.get_allocator().is_mapped(v.capacity()) ? resident_bytes(v.data(), bytes) : bytes;
}
/// Memory that a vector and its copies have at least, bytes: that of pages that are not zero.
template <class T>
std::size_t memory_of(const HeldRows<T>& v) {
  if (!v.get_allocator().is_mapped(v.capacity())) return v.capacity() * sizeof(T);
  std::size_t bytes = 0;
  v.for_each_written([&](std::size_t, std::size_t n) { bytes += n * sizeof(T); });
  return bytes;
}
template <class T, class Allocator>
std::size_t memory_of(const std::vector<T, Allocator>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace acinus
