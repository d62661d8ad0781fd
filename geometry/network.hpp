#pragma once
/// Network of blood vessels: a graph of segments, each a tapered capsule.

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

/// Upper bound of the displacement of any point of the walls between two states of a network, um,
/// from nodes and radii. Infinite if their segments differ.
double largest_motion(const Network& now, const Network& then);

}  // namespace acinus::geometry
