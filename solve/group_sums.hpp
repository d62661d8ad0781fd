#pragma once
/// Sums over the points of groups of cells, the same for any partition among processes and threads.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/numbers/exact_sum.hpp"
#include "core/parallel/threads.hpp"
#include "solve/cell_groups.hpp"

namespace acinus::solve {

/// Sums over groups of cells. Every own block sums over its points for each of its groups; these
/// parts are added exactly, or, where a group has few of them, in the order of the blocks.
class GroupSums {
 public:
  /// Indexes the parts of the groups, which are to stay until the last sum. Collective.
  void prepare(const System& system, const CellGroups& groups);

  /// Sums N numbers over the points of each group. Collective.
  /// @param f    f(address, group, numbers): adds the contribution of a point
  /// @param put  put(group, numbers): receives the sums, of groups with own cells
  template <std::size_t N, class F, class Put>
  void sum(const F& f, const Put& put);

  /// Largest value of the points of each group. @param f  f(address, group) >= 0
  template <class F>
  void largest(const F& f, std::vector<double>& value) const;

  /// Calls f(address, group) for every point of own blocks; f writes to that point only.
  template <class F>
  void for_each_point(const F& f) const {
    for_each_index(own_.size(), worth_threads(system_->n_row),
                   [&](std::size_t k) { for_each_point(own_[k], f); });
  }

 private:
  void count_shared_parts();
  /// Contribution of one block to one group, or shared group.
  struct GroupPart {
    int block, group;
  };
  template <std::size_t N>
  struct GroupPartSum {
    GroupPart part;
    std::array<double, N> number;
  };
  static constexpr std::size_t kFewParts = 8;

  template <class F>
  void for_each_point(std::size_t b, const F& f) const {
    const Block& block = system_->block[b];
    for (std::size_t l = 0; l < kLanes; ++l)
      if (const int g = groups_->of_cell[b * kLanes + l]; g >= 0)
        for (int i = 0; i < block.pattern->n_point; ++i)
          f(make_address(block.first_row + i, static_cast<int>(l)), g);
  }
  std::span<const std::uint32_t> parts_of(int group) const {
    if (group < 0) return {};
    return std::span(by_group_).subspan(start_[group], start_[group + 1] - start_[group]);
  }
  template <std::size_t N>
  void add_exactly(std::span<const std::uint32_t> parts,
                   std::span<const std::array<double, N>> number, std::span<ExactSum, N> sum) const;

  const System* system_ = nullptr;
  const CellGroups* groups_ = nullptr;
  std::vector<std::size_t> own_;         ///< numbers of own blocks
  std::vector<std::size_t> first_part_;  ///< [own blocks + 1]
  std::vector<GroupPart> part_;          ///< of own blocks, ascending
  std::vector<std::uint32_t> by_group_;  ///< numbers of parts, group by group
  std::vector<std::size_t> start_;       ///< [n_group + 1] in by_group_
  std::vector<std::uint8_t> is_shared_;  ///< [n_group] 1: several processes have parts
  std::vector<int> few_, many_;          ///< shared groups, by the parts of all processes
  std::vector<double> scratch_;          ///< [part][number] of a sum
  std::vector<std::size_t> next_;        ///< scratch
};

template <std::size_t N>
void GroupSums::add_exactly(std::span<const std::uint32_t> parts,
                            std::span<const std::array<double, N>> number,
                            std::span<ExactSum, N> sum) const {
  constexpr std::size_t kLeastShared = 2000;  // parts
  const std::size_t n_part = parts.size() * N > kLeastShared ? thread_count() : 1;
  const auto add = [&](std::size_t part, std::span<ExactSum> to) {
    for (std::size_t k = part * parts.size() / n_part; k < (part + 1) * parts.size() / n_part; ++k)
      for (std::size_t n = 0; n < N; ++n) to[n].add(number[parts[k]][n]);
  };
  if (n_part == 1) return add(0, sum);
  std::vector<std::array<ExactSum, N>> sums(n_part);
  for_each_part(n_part, [&](std::size_t part) { add(part, sums[part]); });
  for (const auto& s : sums)
    for (std::size_t n = 0; n < N; ++n) sum[n].add(s[n]);
}

template <std::size_t N, class F, class Put>
void GroupSums::sum(const F& f, const Put& put) {
  scratch_.resize(N * part_.size());
  const std::span<std::array<double, N>> number(
      reinterpret_cast<std::array<double, N>*>(scratch_.data()), part_.size());
  for_each_index(own_.size(), worth_threads(system_->n_row), [&](std::size_t k) {
    for (std::size_t p = first_part_[k]; p < first_part_[k + 1]; ++p) number[p].fill(0);
    for_each_point(own_[k], [&](Address a, std::size_t g) {
      std::size_t p = first_part_[k];
      while (part_[p].group != static_cast<int>(g)) ++p;
      f(a, g, number[p]);
    });
  });
  const auto value_of = [](std::span<const ExactSum, N> sum) {
    std::array<double, N> value;
    for (std::size_t n = 0; n < N; ++n) value[n] = sum[n].value();
    return value;
  };
  for (std::size_t g = 0; g < groups_->n; ++g) {
    if (is_shared_[g] != 0) continue;
    const std::span<const std::uint32_t> parts = parts_of(static_cast<int>(g));
    if (parts.size() <= kFewParts) {
      std::array<double, N> total{};
      for (const std::uint32_t p : parts)
        for (std::size_t n = 0; n < N; ++n) total[n] += number[p][n];
      put(g, total);
    } else {
      std::array<ExactSum, N> total;
      add_exactly<N>(parts, number, std::span<ExactSum, N>(total));
      put(g, value_of(total));
    }
  }
  const Ranks& ranks = system_->ownership.ranks;
  if (!many_.empty()) {
    std::vector<ExactSum> totals(N * many_.size());
    for (std::size_t k = 0; k < many_.size(); ++k)
      add_exactly<N>(parts_of(groups_->shared[many_[k]]), number,
                     std::span<ExactSum, N>(&totals[N * k], N));
    ranks.sum(totals);
    for (std::size_t k = 0; k < many_.size(); ++k)
      if (const int g = groups_->shared[many_[k]]; g >= 0)
        put(static_cast<std::size_t>(g), value_of(std::span<const ExactSum, N>(&totals[N * k], N)));
  }
  if (few_.empty()) return;
  std::vector<GroupPartSum<N>> own, all;
  for (const int k : few_)
    for (const std::uint32_t p : parts_of(groups_->shared[k]))
      own.push_back({{part_[p].block, k}, number[p]});
  ranks.gather<GroupPartSum<N>>(own, all);
  std::ranges::sort(all, {},
                    [](const GroupPartSum<N>& p) { return std::pair(p.part.group, p.part.block); });
  for (std::size_t k = 0; k < all.size();) {
    const int shared = all[k].part.group;
    std::array<double, N> total{};
    for (; k < all.size() && all[k].part.group == shared; ++k)
      for (std::size_t n = 0; n < N; ++n) total[n] += all[k].number[n];
    if (const int g = groups_->shared[shared]; g >= 0) put(static_cast<std::size_t>(g), total);
  }
}

template <class F>
void GroupSums::largest(const F& f, std::vector<double>& value) const {
  value.assign(groups_->n, 0);
  for (const std::size_t b : own_)
    for_each_point(b, [&](Address a, std::size_t g) { value[g] = std::max(value[g], f(a, g)); });
  if (groups_->shared.empty()) return;
  std::vector<double> shared;
  for (const int g : groups_->shared) shared.push_back(g >= 0 ? value[g] : 0);
  system_->ownership.ranks.max(shared);
  for (std::size_t k = 0; k < shared.size(); ++k)
    if (const int g = groups_->shared[k]; g >= 0) value[g] = shared[k];
}

}  // namespace acinus::solve
