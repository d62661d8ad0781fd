#pragma once
/// From a point row back to the block it belongs to.

#include <algorithm>
#include <vector>

#include "core/solve/system.hpp"

namespace acinus::solve {

/// @param block_of_row [n_row] filled with the number of each row's block
inline void find_row_blocks(const System& s, std::vector<int>& block_of_row) {
  block_of_row.resize(s.n_row);
  for (std::size_t b = 0; b < s.block.size(); ++b)
    std::fill_n(block_of_row.begin() + static_cast<std::ptrdiff_t>(s.block[b].first_row),
                s.block[b].pattern->n_point, static_cast<int>(b));
}

}  // namespace acinus::solve
