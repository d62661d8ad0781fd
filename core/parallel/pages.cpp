#include "core/parallel/pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <vector>

namespace acinus {

namespace {

std::atomic<bool> g_small_pages = false;

std::size_t page_bytes() {
  static const auto bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

}  // namespace

void use_small_pages() { g_small_pages = true; }

void* map_pages(std::size_t bytes) {
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  // Large pages: gathers from arrays of many megabytes would wait for translations of addresses.
  madvise(pages, bytes, g_small_pages ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
  return pages;
}

void unmap_pages(void* pages, std::size_t bytes) noexcept { munmap(pages, bytes); }

void release_pages(void* pages, std::size_t bytes) noexcept {
  madvise(pages, bytes, MADV_DONTNEED);
}

std::size_t resident_bytes(const void* pages, std::size_t bytes) {
  const std::size_t page = page_bytes();
  std::vector<unsigned char> is_there((bytes + page - 1) / page);
  if (mincore(const_cast<void*>(pages), bytes, is_there.data()) != 0) return bytes;
  return page * static_cast<std::size_t>(
                    std::ranges::count_if(is_there, [](unsigned char c) { return (c & 1) != 0; }));
}

}  // namespace acinus
