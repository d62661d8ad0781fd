#pragma once
/// Vectors with numbers for all rows of a system. A process writes those of its own cells and of
/// near ones only; pages that are never written have addresses and no memory.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace acinus {

/// Makes later pages of the smallest size, for vectors of which a process uses scattered parts.
void use_small_pages();

/// Pages of zeros from the system, without memory until they are written.   @throws std::bad_alloc
void* map_pages(std::size_t bytes);
void unmap_pages(void* pages, std::size_t bytes) noexcept;
/// Returns the memory of mapped pages, which become zero.
void release_pages(void* pages, std::size_t bytes) noexcept;
/// Memory that mapped pages have, bytes.
std::size_t resident_bytes(const void* pages, std::size_t bytes);

/// Allocator of row vectors: maps large arrays, and leaves new elements as they are.
template <class T>
struct RowAllocator {
  using value_type = T;
  static_assert(std::is_trivially_destructible_v<T>);

  RowAllocator() = default;
  template <class U>
  explicit RowAllocator(const RowAllocator<U>& /*other*/) {}

  /// Smallest array that is mapped, bytes. With AddressSanitizer, which knows no bounds of mapped
  /// arrays, none is.
#if defined(__SANITIZE_ADDRESS__)
  static constexpr std::size_t kSmallestMapped = static_cast<std::size_t>(-1);
#else
  static constexpr std::size_t kSmallestMapped = std::size_t{1} << 16;
#endif
  static constexpr bool is_mapped(std::size_t n) { return n * sizeof(T) >= kSmallestMapped; }

  T* allocate(std::size_t n) {
    return is_mapped(n) ? static_cast<T*>(map_pages(n * sizeof(T)))
                        : std::allocator<T>().allocate(n);
  }
  void deallocate(T* p, std::size_t n) noexcept {
    if (is_mapped(n))
      unmap_pages(p, n * sizeof(T));
    else
      std::allocator<T>().deallocate(p, n);
  }
  void construct(T* /*place*/) noexcept {}  // writes nothing: see the top of the file
  template <class First, class... More>
  void construct(T* place, First&& first, More&&... more) {
    ::new (static_cast<void*>(place)) T(std::forward<First>(first), std::forward<More>(more)...);
  }
  bool operator==(const RowAllocator& /*other*/) const { return true; }
};

template <class T>
using RowVector = std::vector<T, RowAllocator<T>>;

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

/// Memory that a vector has, bytes.
template <class T>
std::size_t memory_of(const RowVector<T>& v) {
  const std::size_t bytes = v.capacity() * sizeof(T);
  return v.get_allocator().is_mapped(v.capacity()) ? resident_bytes(v.data(), bytes) : bytes;
}
template <class T>
std::size_t memory_of(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace acinus
