#pragma once
/// New deformable cells come to rest among their neighbours before the world goes on.

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
  std::map<std::int64_t, double> shift;     ///< um, farthest a node of each cell moved
  std::map<std::int64_t, double> pressure;  ///< kPa, of each cell's cytosol
};

/// Lets new deformable cells settle against each other and their neighbours, which stand still, so
/// that the next step of the whole world is an ordinary one. Without success all stay where they
/// were.
/// @param cells  lineages
Settled settle_cells(World& world, const std::vector<std::int64_t>& cells);

}  // namespace acinus::coupling
