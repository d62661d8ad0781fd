#include "solve/group_sums.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace acinus::solve {

void GroupSums::prepare(const System& system, const CellGroups& groups) {
  system_ = &system;
  groups_ = &groups;
  own_.clear();
  first_part_.assign(1, 0);
  part_.clear();
  for (const auto& [first, last] : system.own)
    for (std::size_t b = first; b < last; ++b) {
      const auto lanes = std::span(groups.of_cell).subspan(b * kLanes, kLanes);
      for (std::size_t l = 0; l < kLanes; ++l)
        if (const int g = lanes[l]; g >= 0 && std::ranges::find(lanes.first(l), g) ==
                                                  lanes.begin() + static_cast<std::ptrdiff_t>(l))
          part_.push_back({static_cast<int>(b), g});
      own_.push_back(b);
      first_part_.push_back(part_.size());
    }
  start_.assign(groups.n + 1, 0);
  for (const GroupPart& p : part_) ++start_[p.group + 1];
  for (std::size_t g = 0; g < groups.n; ++g) start_[g + 1] += start_[g];
  by_group_.resize(part_.size());
  next_.assign(start_.begin(), start_.end() - 1);
  for (std::size_t p = 0; p < part_.size(); ++p)
    by_group_[next_[part_[p].group]++] = static_cast<std::uint32_t>(p);
  count_shared_parts();
}

/// Sorts shared groups by their number of parts: few or many.
void GroupSums::count_shared_parts() {
  is_shared_.assign(groups_->n, 0);
  few_.clear();
  many_.clear();
  if (groups_->shared.empty()) return;
  struct Count {
    int shared, n;
  };
  std::vector<Count> own, all;
  for (std::size_t k = 0; k < groups_->shared.size(); ++k) {
    const int g = groups_->shared[k];
    if (g < 0) continue;
    is_shared_[g] = 1;
    own.push_back({static_cast<int>(k), static_cast<int>(parts_of(g).size())});
  }
  system_->ownership.ranks.gather<Count>(own, all);
  std::vector<std::size_t> n_part(groups_->shared.size(), 0);
  for (const Count& c : all) n_part[c.shared] += static_cast<std::size_t>(c.n);
  for (std::size_t k = 0; k < n_part.size(); ++k)
    (n_part[k] > kFewParts ? many_ : few_).push_back(static_cast<int>(k));
}

}  // namespace acinus::solve
