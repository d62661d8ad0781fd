#pragma once
/// Leaders: cells at the edge of the lesion that respond to its signal. [VanLiedekerke2020, section
/// 3.3, Model III]

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Cell in cylinder coordinates about the vein axis.
struct PolarCell {
  double distance = 0, angle = 0, height = 0, radius = 0;  ///< um, rad, um, um
  bool exists = false;
  bool led = false;  ///< true if it is a leader so far
};

/// Finds the leaders by the rule of `motility`; 1 for leaders. Cells touching the wall of the vein
/// never lead. A leader keeps its role until another cell is nearer by a sixth of a radius, which
/// prevents alternation of equal cells.
/// @param walls  bounds of the lesion (Leaders::kBorder)
std::vector<std::uint8_t> find_leaders(const Motility& motility, std::span<const PolarCell> cells,
                                       std::span<const contact::Plane> walls = {});

/// Chooses the leaders in a new interval of their time grid. Pure in time and positions: a retry
/// chooses the same.
/// @param leader  [dcm lanes, then cbm cells]
/// @return true if leaders were chosen anew
bool choose_leaders(const Params& params, const State& at, std::span<const double> dcm_radius,
                    std::span<const double> cbm_radius, std::vector<std::uint8_t>& leader,
                    std::int64_t& interval);

}  // namespace acinus::coupling
