#include "solve/system.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel/make_room.hpp"

namespace acinus::solve {
namespace {

/// Clears the elements of own blocks.
void clear_own(const System& s, RowVector<float>& v, std::size_t Block::*first,
               std::size_t stride) {
  for_each_own_number(
      s, [&](const Block& b) { return b.*first * stride; }, v.size(),
      [&](std::size_t k) { v[k] = 0; });
}

}  // namespace

void index_springs(BlockPattern& p) {
  p.first_spring_of.assign(p.n_point + 1, 0);
  for (const auto& s : p.spring)
    for (int i : s) ++p.first_spring_of[i + 1];
  for (std::size_t i = 1; i < p.first_spring_of.size(); ++i)
    p.first_spring_of[i] += p.first_spring_of[i - 1];
  p.spring_of.resize(2 * p.spring.size());
  std::vector<std::size_t> next = p.first_spring_of;
  for (std::size_t k = 0; k < p.spring.size(); ++k) {
    const auto [i, j] = p.spring[k];
    p.spring_of[next[i]++] = {j, static_cast<int>(k)};
    p.spring_of[next[j]++] = {i, static_cast<int>(k)};
  }
}

void set_blocks(System& system, Blocks blocks) {
  system.block = std::move(blocks);
  const Block& end = system.block.end();
  system.n_row = end.first_row;
  system.own = find_own_runs(system.ownership, system.block.size());
  set_size(system.force, system.n_dof());
  set_size(system.external_force, system.n_dof());
  set_size(system.medium, system.n_row * kLanes);
  set_size(system.shape, end.first_shape * kPointStride);
  set_size(system.spring, end.first_spring * kSpringStride);
  set_size(system.hinge, end.first_hinge * kHingeStride);
  set_size(system.face, end.first_face * kFaceStride);
  set_size(system.beam, end.first_beam * kBeamStride);
  clear_own(system, system.shape, &Block::first_shape, kPointStride);
  clear_own(system, system.hinge, &Block::first_hinge, kHingeStride);
  clear_own(system, system.face, &Block::first_face, kFaceStride);
  clear_own(system, system.beam, &Block::first_beam, kBeamStride);
  clear_loads(system);
}

void stream_rows(const System& s, std::span<const double> x,
                 const std::function<void(std::size_t, std::span<const double>)>& put,
                 std::size_t most) {
  const auto begin = [&](std::size_t b) { return s.row_of(b) * kPointStride; };
  const auto rows_of = [&](std::size_t b) { return x.subspan(begin(b), begin(b + 1) - begin(b)); };
  const Ownership& ownership = s.ownership;
  const std::size_t n = s.block.size();
  if (ownership.is_whole()) {
    put(0, x);
    return;
  }
  std::vector<double> own, by_rank;
  std::vector<std::size_t> next;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    own.clear();
    do {
      const std::span<const double> rows = rows_of(last);
      if (ownership.owns(last)) own.insert(own.end(), rows.begin(), rows.end());
    } while (++last < n && s.row_of(last + 1) - s.row_of(first) <= most);
    ownership.ranks.gather<double>(own, by_rank, &next);
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t count = begin(b + 1) - begin(b);
      std::size_t& from = next[ownership.owner[b]];
      put(begin(b), std::span<const double>(by_rank).subspan(from, count));
      from += count;
    }
  }
}

void gather_rows(const System& s, std::span<double> x) {
  if (s.ownership.is_whole()) return;
  stream_rows(s, x, [&](std::size_t k, std::span<const double> rows) {
    std::ranges::copy(rows, x.begin() + static_cast<std::ptrdiff_t>(k));
  });
}

void clear_loads(System& system) {
  for (auto* v : {&system.force, &system.external_force}) clear_own_rows(system, kPointStride, *v);
  clear_own_rows(system, kLanes, system.medium);
  clear_own(system, system.spring, &Block::first_spring, kSpringStride);
  for (RankOne& r : system.rank_one) {
    clear_own_rows(system, kPointStride, r.vector);
    for_each_number(r.coefficient.size(), [&](std::size_t k) { r.coefficient[k] = 0; });
  }
  system.links.clear();
}

}  // namespace acinus::solve
