#pragma once
/// Distribution of the blocks of a system among processes. Every process knows all blocks and
/// numbers them alike; it computes its own, and reads of the others only the points that its
/// contacts need.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/ranks.hpp"

namespace acinus::solve {

struct Ownership {
  Ranks ranks = Ranks::serial();
  std::vector<int> owner;  ///< [n_block] rank; empty: all are own

  bool is_whole() const { return owner.empty(); }
  bool owns(std::size_t block) const { return owner.empty() || owner[block] == ranks.rank(); }
};

/// Consecutive own blocks: [first, last).
using BlockRun = std::pair<std::size_t, std::size_t>;

/// Runs of own blocks among n blocks, ascending.
inline std::vector<BlockRun> find_own_runs(const Ownership& o, std::size_t n) {
  std::vector<BlockRun> runs;
  for (std::size_t b = 0; b < n; ++b) {
    if (!o.owns(b)) continue;
    if (!runs.empty() && runs.back().second == b)
      ++runs.back().second;
    else
      runs.emplace_back(b, b + 1);
  }
  return runs;
}

/// Processes that get gathered values.
enum class Receivers { kAll, kRoot };

/// Gathers values of items that are computed by one process each, in the order of the items, 8 MB
/// at a time.
/// @param owner  owner(k): rank of item k < n
/// @param count  count(k): its number of values
/// @param own    values of own items
/// @param all    values of all items; empty on processes that do not receive them
template <class T, class Owner, class Count>
void gather_in_order(const Ranks& ranks, std::size_t n, const Owner& owner, const Count& count,
                     const std::vector<T>& own, std::vector<T>& all,
                     Receivers receivers = Receivers::kAll,
                     Ranks::Place place = Ranks::Place::current()) {
  constexpr std::size_t kMostBytes = 8 << 20;
  const bool at_root = receivers == Receivers::kRoot, receives = !at_root || ranks.is_root();
  std::size_t n_all = 0;
  for (std::size_t k = 0; k < n; ++k) n_all += count(k);
  all.clear();
  if (receives) all.reserve(n_all);
  std::vector<T> by_rank;
  std::vector<std::size_t> next;
  std::size_t sent = 0;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    std::size_t n_here = 0, n_own = 0;
    do {
      n_here += count(last);
      n_own += owner(last) == ranks.rank() ? count(last) : 0;
    } while (++last < n && (n_here + count(last)) * sizeof(T) <= kMostBytes);
    const std::span<const T> part = std::span(own).subspan(sent, n_own);
    sent += n_own;
    if (at_root)
      ranks.gather_at_root<T>(part, by_rank, &next, place);
    else
      ranks.gather<T>(part, by_rank, &next, place);
    for (std::size_t k = first; k < last && receives; ++k) {
      std::size_t& from = next[owner(k)];
      const auto begin = by_rank.begin() + static_cast<std::ptrdiff_t>(from);
      from += count(k);
      all.insert(all.end(), begin, by_rank.begin() + static_cast<std::ptrdiff_t>(from));
    }
  }
}

}  // namespace acinus::solve
