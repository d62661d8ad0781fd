#pragma once
/// Box of a cell as processes send it.

#include <array>
#include <cstddef>

#include "core/box.hpp"

namespace acinus::coupling {

/// Lane of a cell, then the low and the high corner of its box, um.
using LaneBox = std::array<double, 7>;

inline LaneBox pack_box(std::size_t lane, const Box& b) {
  return {static_cast<double>(lane), b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]};
}
inline std::size_t lane_of(const LaneBox& b) { return static_cast<std::size_t>(b[0]); }
inline Box box_of(const LaneBox& b) { return {{b[1], b[2], b[3]}, {b[4], b[5], b[6]}}; }

}  // namespace acinus::coupling
