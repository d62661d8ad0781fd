#include "coupling/step/held_contacts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "coupling/step/ghost_cells.hpp"

namespace acinus::coupling {
namespace {

using Pair = std::pair<int, int>;
using Sent = std::array<int, 2>;

/// Process of the second sphere of a pair; that of the first for a contact with the boundary.
int process_of_second(std::span<const int> process, const Pair& pair) {
  return process[static_cast<std::size_t>(pair.second < 0 ? pair.first : pair.second)];
}

void sort_once(std::vector<Pair>& pairs) {
  std::ranges::sort(pairs);
  const auto repeated = std::ranges::unique(pairs);
  pairs.erase(repeated.begin(), repeated.end());
}

/// Adds the pairs that others send to all, and the own ones among them.
void exchange_pairs(const Ranks& ranks, const std::vector<Sent>& own, std::vector<Pair>& pairs) {
  std::vector<Sent> all;
  ranks.gather<Sent>(own, all);
  if (all.empty()) return;
  for (const auto& [a, b] : all) pairs.emplace_back(a, b);
  sort_once(pairs);
}

}  // namespace

void hand_over_contacts(const Workspace& w, State& s) {
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return complete_contacts(ownership.ranks, s);
  if (s.cbm.n_cell() == 0) return;
  std::vector<int> owner(s.cbm.n_cell());
  for (std::size_t c = 0; c < owner.size(); ++c) owner[c] = owner_of_lane(w, w.dcm_lanes + c);
  if (s.holder == owner) return;
  const int self = ownership.ranks.rank();
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
    exchange_pairs(ownership.ranks, sent, pairs);
  }
  std::erase_if(pairs, [&](const Pair& pair) {
    return owner[static_cast<std::size_t>(pair.first)] != self &&
           process_of_second(owner, pair) != self;
  });
  pairs.shrink_to_fit();
  s.holder = std::move(owner);
}

void complete_contacts(const Ranks& ranks, State& s) {
  if (s.holder.empty()) return;
  std::vector<Sent> own;
  for (const Pair& pair : s.cbm.touching)
    if (s.holder[static_cast<std::size_t>(pair.first)] == ranks.rank())
      own.push_back({pair.first, pair.second});
  exchange_pairs(ranks, own, s.cbm.touching);
  s.holder.clear();
}

}  // namespace acinus::coupling
