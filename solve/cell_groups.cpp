#include "solve/cell_groups.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/parallel/threads.hpp"
#include "core/sort_unique.hpp"
#include "solve/border_exchange.hpp"
#include "solve/link_kernels.hpp"

namespace acinus::solve {
namespace {

/// Joins own cells in contact with each other. @return pairs in contact across processes
std::vector<BorderPair> join_own_cells(const System& s, DisjointSets& sets) {
  const auto owns = [&](LaneIndex cell) { return s.ownership.owns(cell / kLanes); };
  const std::size_t n_part = count_threads(s.n_row);
  std::vector<std::vector<BorderPair>> across(s.ownership.is_whole() ? 0 : n_part);
  // Contacts come sorted by pair of cells.
  const auto join_all = [&](const auto& links, const auto& ends) {
    for_each_part(n_part, [&](std::size_t part) {
      BorderPair last{};
      for (std::size_t l = part * links.size() / n_part; l < (part + 1) * links.size() / n_part;
           ++l) {
        const auto [end_a, end_b] = ends(links[l]);
        if (end_b == kNowhere) continue;
        const BorderPair pair{s.lane_of(end_a), s.lane_of(end_b)};
        if (pair == last) continue;
        last = pair;
        const auto [a, b] = pair;
        if (owns(a) && owns(b))
          sets.join(static_cast<int>(a), static_cast<int>(b));
        else if (owns(a))
          across[part].push_back({a, b});
        else if (owns(b))
          across[part].push_back({b, a});
      }
    });
  };
  join_all(s.links.link, [](const Link& l) { return std::array{l.a.point[0], l.b.point[0]}; });
  join_all(s.point_links, [&](const PointLink& l) {
    // Pairs of spheres are listed before they touch, some steps sooner or later.
    return std::array{l.a, has_matrix(l, s.stiffness_scale) ? l.b : kNowhere};
  });
  std::vector<BorderPair> pairs;
  for (const std::vector<BorderPair>& part : across)
    pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

/// Sets of own cells that contacts join across processes, each named by its lowest cell, with the
/// number of the group that they are part of.
class SharedSets {
 public:
  /// Finds them from pairs in contact across processes. Collective.
  SharedSets(const Ownership& ownership, std::span<const BorderPair> pairs, DisjointSets& own) {
    const BorderExchange border = plan_border_exchange(ownership, pairs);
    std::vector<LaneIndex> out, in(border.receive.size());
    for (const LaneIndex c : border.send) out.push_back(name_of(c, own));
    ownership.ranks.exchange<LaneIndex>(border.plan, out, in);
    std::vector<std::pair<LaneIndex, LaneIndex>> name;  // of cells of others
    for (std::size_t k = 0; k < in.size(); ++k) name.emplace_back(border.receive[k], in[k]);
    std::ranges::sort(name);

    std::vector<BorderPair> joined, all;
    for (const auto& [cell, other] : pairs) {
      if (cell > other) continue;  // the other process adds this pair
      const auto at =
          std::ranges::lower_bound(name, other, {}, &std::pair<LaneIndex, LaneIndex>::first);
      joined.push_back({name_of(cell, own), at->second});
    }
    sort_unique(joined);
    ownership.ranks.gather<BorderPair>(joined, all);

    for (const BorderPair& p : all) set_.insert(set_.end(), p.begin(), p.end());
    sort_unique(set_);
    DisjointSets sets(set_.size());
    for (const auto& [a, b] : all)
      sets.join(static_cast<int>(*find(a)), static_cast<int>(*find(b)));
    for (std::size_t k = 0; k < set_.size(); ++k) {
      const auto first = static_cast<std::size_t>(sets.find(static_cast<int>(k)));
      group_.push_back(first == k ? n_group_++ : group_[first]);
    }
  }

  std::size_t n_group() const { return static_cast<std::size_t>(n_group_); }
  /// Shared group of a set of own cells. @return -1 if no process shares it
  int group_of(LaneIndex set) const {
    const auto k = find(set);
    return k ? group_[*k] : -1;
  }

 private:
  static LaneIndex name_of(LaneIndex cell, DisjointSets& own) {
    return static_cast<LaneIndex>(own.find(static_cast<int>(cell)));
  }
  std::optional<std::size_t> find(LaneIndex set) const {
    const auto at = std::ranges::lower_bound(set_, set);
    if (at == set_.end() || *at != set) return std::nullopt;
    return static_cast<std::size_t>(at - set_.begin());
  }

  std::vector<LaneIndex> set_;  ///< names, ascending
  std::vector<int> group_;      ///< [set]
  int n_group_ = 0;
};

}  // namespace

void find_groups(const System& s, std::span<const std::uint8_t> active, CellGroups& groups) {
  DisjointSets& sets = groups.sets;
  sets.set_size(active.size());
  set_size(groups.of_cell, active.size());
  for (const auto& [first, last] : s.own) {
    sets.separate(first * kLanes, last * kLanes);
    std::fill_n(groups.of_cell.data() + first * kLanes, (last - first) * kLanes, -1);
  }
  const std::vector<BorderPair> pairs = join_own_cells(s, sets);
  std::optional<SharedSets> shared;
  if (!s.ownership.is_whole()) shared.emplace(s.ownership, pairs, sets);
  groups.shared.assign(shared ? shared->n_group() : 0, -1);
  int n = 0;
  const auto number_of = [&](LaneIndex set) {
    const int k = shared ? shared->group_of(set) : -1;
    if (k < 0) return n++;
    int& number = groups.shared[k];
    if (number < 0) number = n++;
    return number;
  };
  for (const auto& [first, last] : s.own)
    for (std::size_t c = first * kLanes; c < last * kLanes; ++c) {
      if (active[c] == 0) continue;
      const int set = sets.find(static_cast<int>(c));
      int& group = groups.of_cell[set];
      if (group < 0) group = number_of(static_cast<LaneIndex>(set));
      groups.of_cell[c] = group;
    }
  groups.n = static_cast<std::size_t>(n);
}

}  // namespace acinus::solve
