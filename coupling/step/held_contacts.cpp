#include "coupling/step/held_contacts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/sort_unique.hpp"
#include "coupling/step/ghost_cells.hpp"

namespace acinus::coupling {
namespace {

using Pair = std::pair<int, int>;
using Sent = std::array<int, 2>;

/// Process of the second sphere of a pair; that of the first for a contact with the boundary.
int process_of_second(const PagedValues<int>& process, const Pair& pair) {
  return process[static_cast<std::size_t>(pair.second < 0 ? pair.first : pair.second)];
}

/// Adds pairs of all processes, sorted.
void add_pairs(const std::vector<Sent>& all, std::vector<Pair>& pairs) {
  if (all.empty()) return;
  for (const auto& [a, b] : all) pairs.emplace_back(a, b);
  sort_unique(pairs);
}

/// Pairs of which this process holds the first sphere.
std::vector<Sent> list_held(const Ranks& ranks, const State& s) {
  std::vector<Sent> own;
  for (const Pair& pair : s.cbm.touching)
    if (s.holder[static_cast<std::size_t>(pair.first)] == ranks.rank())
      own.push_back({pair.first, pair.second});
  return own;
}

/// Removes the pairs without a sphere of this process.
/// @param process  [cbm cells]
void keep_own(const Ranks& ranks, const PagedValues<int>& process, std::vector<Pair>& pairs) {
  const auto has = [&](int p) { return p == ranks.rank() || p == kEverywhere; };
  std::erase_if(pairs, [&](const Pair& pair) {
    return !has(process[static_cast<std::size_t>(pair.first)]) &&
           !has(process_of_second(process, pair));
  });
  pairs.shrink_to_fit();
}

}  // namespace

void hand_over_contacts(const Ranks& ranks, const Workspace& w, State& s) {
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return complete_contacts(ranks, s);
  if (s.cbm.n_cell() == 0) return;
  const auto owner_of = [&](std::size_t c) { return owner_of_lane(w, w.dcm_lanes + c); };
  bool same = s.holder.size() == s.cbm.n_cell();
  for (std::size_t c = 0; same && c < s.holder.size(); ++c) same = s.holder[c] == owner_of(c);
  if (same) return;
  PagedValues<int> owner(s.cbm.n_cell(), owner_of);
  const int self = ranks.rank();
  std::vector<Pair>& pairs = s.cbm.touching;
  if (!s.holder.empty()) {
    // The holder of its first sphere sends a pair that one of the new owners does not have.
    std::vector<Sent> sent;
    for (const Pair& pair : pairs) {
      const int first = s.holder[static_cast<std::size_t>(pair.first)];
      if (first != self) continue;
      const int second = process_of_second(s.holder, pair);
      for (const int next :
           {owner[static_cast<std::size_t>(pair.first)], process_of_second(owner, pair)})
        if (next != first && next != second) {
          sent.push_back({pair.first, pair.second});
          break;
        }
    }
    std::vector<Sent> all;
    ranks.gather<Sent>(sent, all);
    add_pairs(all, pairs);
  }
  keep_own(ranks, owner, pairs);
  s.holder = std::move(owner);
}

void complete_contacts(const Ranks& ranks, State& s) {
  if (s.holder.empty()) return;
  std::vector<Sent> all;
  ranks.gather<Sent>(list_held(ranks, s), all);
  add_pairs(all, s.cbm.touching);
  s.holder.clear();
}

}  // namespace acinus::coupling
