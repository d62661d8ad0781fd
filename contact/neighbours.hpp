#pragma once
/// Neighbour list of spheres.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace acinus::contact {

/// Mark of a sphere whose position is not known.
inline constexpr std::uint8_t kAbsentSphere = 3;

/// Pairs (i, j), i < j, of all spheres whose surfaces are closer than `margin`, um, in ascending
/// order. They replace those in `pairs`, whose memory is used again.
/// Cost linear in spheres and pairs (uniform grid of the largest sphere). The same for any number
/// of threads.
/// @param position  [row][3][lane] um, sphere i in lane i % kLanes of row i / kLanes
/// @param radius    [n_sphere] um
/// @param ghost     [n_sphere] not 0: ghost cell. Pairs of two ghost cells are left out, and so are
///     kAbsentSphere; empty: none
void find_sphere_pairs(const double* position, std::span<const double> radius, double margin,
                       std::span<const std::uint8_t> ghost,
                       std::vector<std::pair<int, int>>& pairs);

}  // namespace acinus::contact
