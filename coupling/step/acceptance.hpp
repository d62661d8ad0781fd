#pragma once
/// Stage 7: whether a computed displacement may become State: finite, small enough, no face turned
/// over, no contact driven deep.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct Assessment {
  bool accepted = true;
  std::string cause;                ///< of rejection
  std::vector<std::int64_t> cells;  ///< lineages of the cells concerned
  double error = 0;                 ///< um
  double max_move = 0;              ///< um
};

/// Largest displacement a cell may make in one step, um: max_move mean edges of its mesh; spheres
/// as a 162-node mesh of their radius. Infinite when max_move is 0.
double move_limit(double max_move, double mean_edge);
inline constexpr double kSphereEdge = 0.3;  ///< mean edge of a 162-node mesh, in radii

Assessment assess_step(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
