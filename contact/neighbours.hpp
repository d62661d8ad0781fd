#pragma once
/// Which spheres come near each other.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace acinus::contact {

/// All pairs (i, j), i < j, of spheres whose surfaces are closer than `margin`; ascending order.
/// Cost linear in spheres and pairs (uniform grid of the largest sphere). The same for any number
/// of threads.
/// @param position  [row][3][lane] um, sphere i in lane i % kLanes of row i / kLanes
/// @param radius    [n_sphere] um
/// @param ghost   [n_sphere] pairs of two with a 1 are left out; empty: none are
std::vector<std::pair<int, int>> find_sphere_pairs(const double* position,
                                                   std::span<const double> radius, double margin,
                                                   std::span<const std::uint8_t> ghost = {});

}  // namespace acinus::contact
