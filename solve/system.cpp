#include "solve/system.hpp"

#include <algorithm>

#include "core/parallel/arrays.hpp"

namespace acinus::solve {

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

void set_blocks(System& system, std::vector<Block> blocks) {
  system.n_row = 0;
  std::size_t n_spring = 0, n_hinge = 0, n_face = 0, n_beam = 0;
  for (Block& b : blocks) {
    b.first_row = system.n_row;
    b.first_spring = n_spring;
    b.first_hinge = n_hinge;
    b.first_face = n_face;
    b.first_beam = n_beam;
    system.n_row += b.pattern->n_point;
    n_spring += b.pattern->spring.size();
    n_hinge += b.pattern->wing.size();
    n_face += b.pattern->face.size();
    n_beam += b.pattern->beam.size();
  }
  system.block = std::move(blocks);
  system.own = find_own_runs(system.ownership, system.block.size());
  system.block_of_row.clear();
  for (std::size_t b = 0; b < system.block.size(); ++b)
    system.block_of_row.insert(system.block_of_row.end(), system.block[b].pattern->n_point,
                               static_cast<int>(b));
  set_size(system.force, system.n_dof());
  set_size(system.external_force, system.n_dof());
  set_size(system.medium, system.n_row * kLanes);
  set_size(system.spring, n_spring * kSpringStride);
  assign_zeros(system.hinge, n_hinge * kHingeStride);
  assign_zeros(system.face, n_face * kFaceStride);
  assign_zeros(system.beam, n_beam * kBeamStride);
  clear_loads(system);
}

void gather_rows(const System& s, std::span<double> x) {
  const Ownership& ownership = s.ownership;
  if (ownership.is_whole()) return;
  std::vector<double> own, all;
  const auto n_number = [&](std::size_t b) {
    return (s.row_of(b + 1) - s.row_of(b)) * kPointStride;
  };
  for (const auto& [first, last] : s.own) {
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(s.row_of(first) * kPointStride);
    own.insert(own.end(), from,
               x.begin() + static_cast<std::ptrdiff_t>(s.row_of(last) * kPointStride));
  }
  gather_in_order(
      ownership.ranks, s.block.size(), [&](std::size_t b) { return ownership.owner[b]; }, n_number,
      own, all);
  std::ranges::copy(all, x.begin());
}

void clear_loads(System& system) {
  clear_numbers(system.force);
  clear_numbers(system.external_force);
  clear_numbers(system.medium);
  clear_numbers(system.spring);
  for (RankOne& r : system.rank_one) {
    clear_numbers(r.vector);
    clear_numbers(r.coefficient);
  }
  system.links.clear();
}

}  // namespace acinus::solve
