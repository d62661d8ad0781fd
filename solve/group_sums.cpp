#include "solve/group_sums.hpp"

#include <algorithm>

namespace acinus::solve {

void GroupSums::prepare(const System& system, std::span<const int> group, std::size_t n_group) {
  system_ = &system;
  group_ = group;
  own_.clear();
  first_part_.assign(1, 0);
  part_.clear();
  // Of all blocks: how many have a part in a group, and whether blocks of several processes do.
  n_part_.assign(n_group, 0);
  owner_of_group_.assign(n_group, -1);
  is_shared_.assign(n_group, 0);
  const Ownership& ownership = system.ownership;
  for (std::size_t b = 0; b < system.block.size(); ++b) {
    const auto lanes = group.subspan(b * kLanes, kLanes);
    const bool own = ownership.owns(b);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const int g = lanes[l];
      if (g < 0 ||
          std::ranges::find(lanes.first(l), g) != lanes.begin() + static_cast<std::ptrdiff_t>(l))
        continue;
      ++n_part_[g];
      if (own) part_.push_back({static_cast<int>(b), g});
      if (ownership.is_whole()) continue;
      if (owner_of_group_[g] >= 0 && owner_of_group_[g] != ownership.owner[b]) is_shared_[g] = 1;
      owner_of_group_[g] = ownership.owner[b];
    }
    if (!own) continue;
    own_.push_back(b);
    first_part_.push_back(part_.size());
  }
  kind_.clear();
  few_.clear();
  many_.clear();
  for (std::size_t g = 0; g < n_group; ++g) {
    kind_.push_back(n_part_[g] > kFewParts ? GroupKind::kMany : GroupKind::kFew);
    if (is_shared_[g] != 0) (kind_[g] == GroupKind::kMany ? many_ : few_).push_back(g);
  }
  start_.assign(n_group + 1, 0);
  for (const GroupPart& p : part_) ++start_[p.group + 1];
  for (std::size_t g = 0; g < n_group; ++g) start_[g + 1] += start_[g];
  by_group_.resize(part_.size());
  next_.assign(start_.begin(), start_.end() - 1);
  for (std::size_t p = 0; p < part_.size(); ++p)
    by_group_[next_[part_[p].group]++] = static_cast<std::uint32_t>(p);
}

}  // namespace acinus::solve
