#pragma once
/// Settling of new deformable cells among their neighbours before the next step of the whole world.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct Settled {
  bool ok = true;
  std::string cause;
  int steps = 0;
  std::map<std::int64_t, double> shift;     ///< um, largest node displacement of each cell
  std::map<std::int64_t, double> pressure;  ///< kPa, of each cell's cytosol
};

/// Settles new deformable cells against each other and their fixed neighbours, so that the next
/// step of the whole world has ordinary length. After a failure all cells keep their positions.
/// @param cells        lineages
/// @param newton_step  s, length of three steps, each one Newton iteration of backward Euler; a
///                     rejected one is halved. 0: as many steps as the error allows, together a
///                     minute, or a step of the whole world if that is shorter
/// @param return_centers  true: the settled cells are then moved back by the shifts of their
///                        centroids and settle for a short step, so that they hardly shift
Settled settle_cells(World& world, const std::vector<std::int64_t>& cells, double newton_step = 0,
                     bool return_centers = false);

}  // namespace acinus::coupling
