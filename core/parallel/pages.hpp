#pragma once
/// Pages of memory from the system, and vectors that use them when they are long.

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

/// Allocator that maps arrays of kSmallest bytes and more, and leaves new elements as they are.
/// With AddressSanitizer, which knows no bounds of mapped arrays, it maps none.
template <class T, std::size_t kSmallest>
struct MappingAllocator {
  using value_type = T;
  static_assert(std::is_trivially_destructible_v<T>);
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): a name of the standard library
    using other = MappingAllocator<U, kSmallest>;  // NOLINT(readability-identifier-naming)
  };

  MappingAllocator() = default;
  template <class U>
  explicit MappingAllocator(const MappingAllocator<U, kSmallest>& /*other*/) {}

  static constexpr bool is_mapped([[maybe_unused]] std::size_t n) {
#if defined(__SANITIZE_ADDRESS__)
    return false;
#else
    return n * sizeof(T) >= kSmallest;
#endif
  }
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
  void construct(T* /*place*/) noexcept {}  // writes nothing
  template <class First, class... More>
  void construct(T* place, First&& first, More&&... more) {
    ::new (static_cast<void*>(place)) T(std::forward<First>(first), std::forward<More>(more)...);
  }
  bool operator==(const MappingAllocator& /*other*/) const { return true; }
};

/// Vector of records that every step writes anew, such as contacts. Large pages spare translations
/// of addresses. Elements that resize() adds have no value.
template <class T>
using LargeVector = std::vector<T, MappingAllocator<T, (std::size_t{1} << 22)>>;

}  // namespace acinus
