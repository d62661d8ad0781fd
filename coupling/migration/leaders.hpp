#pragma once
/// Which cells are leaders: those at the edge of the lesion that feel its signal.
/// [VanLiedekerke2020, section 3.3, Model III]

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// A cell in cylinder coordinates about the vein axis.
struct PolarCell {
  double distance = 0, angle = 0, height = 0, radius = 0;  ///< um, rad, um, um
  bool exists = false;
  bool led = false;  ///< was a leader until now
};

/// Which of the cells lead, by the rule of `motility`; 1 for leaders. A cell whose surface is at
/// the wall of the vein never leads. A leader keeps its place until another cell is nearer by a
/// sixth of a radius, so that equal cells do not take turns.
/// @param walls  behind which there is no lesion (Leaders::kBorder)
std::vector<std::uint8_t> find_leaders(const Motility& motility, std::span<const PolarCell> cells,
                                       std::span<const contact::Plane> walls = {});

/// Chooses the leaders if the grid interval changed. Pure in time and positions: a retry chooses
/// the same.
/// @param leader  [dcm lanes, then cbm cells]
/// @return whether the choice was renewed
bool choose_leaders(const Params& params, const State& at, std::span<const double> dcm_radius,
                    std::span<const double> cbm_radius, std::vector<std::uint8_t>& leader,
                    std::int64_t& interval);

}  // namespace acinus::coupling
