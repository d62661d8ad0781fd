#pragma once
/// Partition of points in space among processes: about equal cost for each, and few neighbours.

#include <span>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"

namespace acinus {

/// Partitions points by recursive coordinate bisection (Zoltan). Collective; all processes pass the
/// same arrays.
/// @param place  [n] um
/// @param cost   [n] above 0
/// @return [n] rank of each point, the same on all processes
std::vector<int> partition(const Ranks& ranks, std::span<const Vec3> place,
                           std::span<const double> cost);

}  // namespace acinus
