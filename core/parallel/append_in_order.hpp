#pragma once
/// List that several threads write, in the order that one thread would give it.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus {

/// Calls f(k, out) for every k < n, and appends all that f appends to out to `all`, in the order of
/// k. Neighbours are taken in runs; a thread holds no more than what it found in one run, but for
/// runs that wait for an earlier one.
/// @param shared  false: on the calling thread, because the work is little
template <class V, class F>
void append_in_order(std::size_t n, bool shared, V& all, const F& f) {
  if (n == 0) return;
  const std::size_t n_thread = shared ? thread_count() : 1;
  constexpr std::size_t kLongestRun = 32, kRunsPerThread = 8;
  const std::size_t run = std::clamp<std::size_t>(n / (kRunsPerThread * n_thread), 1, kLongestRun);
  const std::size_t n_run = (n + run - 1) / run;
  std::atomic<std::size_t> next = 0;
  std::mutex appending;
  std::size_t n_appended = 0;        // runs
  std::map<std::size_t, V> waiting;  // runs that are done before an earlier one
  const auto append = [&](const V& found) {
    make_room(all, found.size());
    all.insert(all.end(), found.begin(), found.end());
    ++n_appended;
  };
  for_each_part(std::min(n_thread, n_run), [&](std::size_t) {
    thread_local V found;  // keeps its memory
    for (std::size_t r; (r = next.fetch_add(1)) < n_run;) {
      found.clear();
      for (std::size_t k = r * run; k < std::min(n, (r + 1) * run); ++k) f(k, found);
      const std::scoped_lock lock(appending);
      if (r != n_appended) {
        waiting.emplace(r, found);
        continue;
      }
      append(found);
      for (; !waiting.empty() && waiting.begin()->first == n_appended;
           waiting.erase(waiting.begin()))
        append(waiting.begin()->second);
    }
  });
}

}  // namespace acinus
