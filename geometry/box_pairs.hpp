#pragma once
/// Neighbour pairs of boxes (broad phase).

#include <span>
#include <utility>
#include <vector>

#include "core/box.hpp"

namespace acinus::geometry {

/// All pairs (i, j), i < j, of boxes closer than `margin` in every direction; ascending order.
/// Cost: linear in boxes and pairs (uniform grid of the largest box).
std::vector<std::pair<int, int>> find_pairs(std::span<const Box> boxes, double margin);

/// All pairs (i of a, j of b) closer than `margin`; ascending order.
std::vector<std::pair<int, int>> find_pairs_between(std::span<const Box> a, std::span<const Box> b,
                                                    double margin);
void find_pairs_between(std::span<const Box> a, std::span<const Box> b, double margin,
                        std::vector<std::pair<int, int>>& pairs);

}  // namespace acinus::geometry
