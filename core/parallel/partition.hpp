#pragma once
/// Shares places in space among processes, so that each has about the same cost and they have few
/// neighbours.

#include <span>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"

namespace acinus {

/// Recursive coordinate bisection, by Zoltan. To be called by all processes with the same numbers.
/// @param place  um, of what is shared
/// @param cost   [the same] > 0
/// @return the rank of each, the same on all processes
std::vector<int> partition(const Ranks& ranks, std::span<const Vec3> place,
                           std::span<const double> cost);

}  // namespace acinus
