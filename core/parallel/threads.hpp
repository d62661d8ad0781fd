#pragma once
/// Work shared among threads. The assignment of parts to threads never affects a result: every part
/// writes its own numbers, and sums are added in the order of the parts.

#include <cstddef>

#include "core/numbers/lanes.hpp"

namespace acinus {

/// Sets the number of threads that share work, at least 1. At the start there is one.
void set_threads(int n);
int thread_count();

/// Number of processors that this process may use.
int processor_count();

/// True if so many point rows are worth sharing (a deformable cell's group has one row per node):
/// below, sharing costs more than it saves.
inline bool worth_threads(std::size_t n_row) { return n_row > 400; }

/// Number of threads for work on n_row point rows; 1 within work that is shared already.
std::size_t count_threads(std::size_t n_row);

namespace threads {
using Part = void (*)(const void* work, std::size_t part);
/// Calls work(part) for all parts; see for_each_part.
void share(std::size_t n_part, const void* work, Part part);
}  // namespace threads

/// Calls f(part) once for every part < n_part. The calling thread works too, and at the end waits
/// only for parts that others have begun: threads that get no processor delay nothing. Within
/// shared work, and while another thread shares some, the calling thread does all of it.
/// @throws an exception of f; unspecified which one if several parts throw
template <class F>
void for_each_part(std::size_t n_part, const F& f) {
  if (n_part == 1) return f(0);
  threads::share(n_part, &f,
                 [](const void* work, std::size_t part) { (*static_cast<const F*>(work))(part); });
}

/// Calls f(k) for every k < n, in runs of neighbours.
/// @param shared  false: on the calling thread, because the work is little
template <class F>
void for_each_index(std::size_t n, bool shared, const F& f) {
  // Several parts a thread: one that comes late gets fewer.
  constexpr std::size_t kPartsPerThread = 8;
  std::size_t n_part = shared ? kPartsPerThread * thread_count() : 1;
  if (thread_count() == 1) n_part = 1;
  if (n_part > n) n_part = n;
  if (n_part == 0) return;
  for_each_part(n_part, [&](std::size_t part) {
    const std::size_t end = (part + 1) * n / n_part;
    for (std::size_t k = part * n / n_part; k < end; ++k) f(k);
  });
}

/// Calls f(k) for every k < n, the numbers of vectors over all points, three lanes to a row.
template <class F>
void for_each_number(std::size_t n, const F& f) {
  for_each_index(n, worth_threads(n / kPointStride), f);
}

}  // namespace acinus
