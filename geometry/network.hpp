#pragma once
/// A network of blood vessels as a graph of segments, each a tapered capsule.

#include <array>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

struct Network {
  std::vector<Vec3> node;                     ///< um
  std::vector<std::array<int, 2>> segment;    ///< node indices
  std::vector<std::array<double, 2>> radius;  ///< [n_segment] um, at the two ends
};

/// Sum of segment lengths, um.
double total_length(const Network& network);

/// How far any place of the walls is from where it was at most, um: nodes and radii. Infinite if
/// they are not the same segments.
double largest_motion(const Network& now, const Network& then);

}  // namespace acinus::geometry
