#pragma once
/// Blocks between the points of one pair of cells, summed in a table.

#include <array>
#include <cstdint>
#include <vector>

#include "solve/link_kernels.hpp"
#include "solve/links.hpp"

namespace acinus::solve {

/// Weights of the three points of a side; a single point has the third weight, whatever is stored.
inline std::array<float, 3> weights_of(const Side& s) {
  if (s.is_single()) return {0, 0, 1};
  return {s.weight[0], s.weight[1], 1 - s.weight[0] - s.weight[1]};
}

ACINUS_INLINE void add_scaled(SymBlock& to, float w, const SymBlock& m) {
  for (std::size_t k = 0; k < m.size(); ++k) to[k] += w * m[k];
}

/// Points of a cell: number k of the cell is point first + k * kLanes.
struct CellPoints {
  Point first = 0;
  std::size_t n = 0;
};

/// Sums of blocks for the pairs of points of one pair of cells.
class PointPairTable {
 public:
  /// Clears the table for another pair of cells.
  void start(CellPoints a, CellPoints b) {
    for (const auto& p : pair_) slot_[p[0] * b_.n + p[1]] = 0;
    pair_.clear();
    block_.clear();
    a_ = a;
    b_ = b;
    if (slot_.size() < a.n * b.n) slot_.resize(a.n * b.n, 0);
  }
  void add(const Side& a, const Side& b, const SymBlock& m) {
    const auto w = weights_of(a), v = weights_of(b);
    const std::size_t first_a = a.is_single() ? 2 : 0, first_b = b.is_single() ? 2 : 0;
    for (std::size_t i = first_a; i < 3; ++i) {
      const std::uint32_t at_a = (a.point[i] - a_.first) / kLanes;
      for (std::size_t j = first_b; j < 3; ++j) {
        const std::uint32_t at_b = (b.point[j] - b_.first) / kLanes;
        std::uint32_t& slot = slot_[at_a * b_.n + at_b];
        if (slot == 0) {
          pair_.push_back({at_a, at_b});
          block_.push_back({});
          slot = static_cast<std::uint32_t>(pair_.size());
        }
        add_scaled(block_[slot - 1], w[i] * v[j], m);
      }
    }
  }
  /// Appends the pairs row by row.
  void emit(PointPairs& out) {
    out.make_room(pair_.size(), a_.n);
    next_.assign(a_.n + 1, 0);
    for (const auto& p : pair_) ++next_[p[0] + 1];
    next_[0] = static_cast<std::uint32_t>(out.b.size());
    for (std::size_t i = 0; i < a_.n; ++i) {
      const std::uint32_t n = next_[i + 1];
      next_[i + 1] += next_[i];
      if (n > 0)
        out.row.push_back({static_cast<Point>(a_.first + i * kLanes), next_[i], next_[i + 1]});
    }
    out.b.resize(out.b.size() + pair_.size());
    out.block.resize(out.b.size());
    for (std::size_t k = 0; k < pair_.size(); ++k) {
      const std::uint32_t to = next_[pair_[k][0]]++;
      out.b[to] = b_.first + pair_[k][1] * kLanes;
      out.block[to] = block_[k];
    }
  }

  std::size_t memory() const {  ///< bytes
    return memory_of(slot_) + memory_of(pair_) + memory_of(block_) + memory_of(next_);
  }

 private:
  CellPoints a_, b_;
  std::vector<std::uint32_t> slot_;  ///< [n_a][n_b] 1 + number of the pair; 0: none
  std::vector<std::array<std::uint32_t, 2>> pair_;
  std::vector<SymBlock> block_;
  std::vector<std::uint32_t> next_;
};

}  // namespace acinus::solve
