#pragma once
/// Stage 7 of a step: the verdict on a computed displacement. It may become State if it is finite
/// and small enough, turns no face over and drives no contact deep.

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
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

/// Largest estimated error of an accepted step, in tolerances, where its length is controlled.
inline constexpr double kMostError = 4;

/// Judges the displacement in work.move. Counts failed solves.
/// @param solved  outcome of the solver
Assessment assess_step(const World& world, double step, const Status& solved, Workspace& work);

}  // namespace acinus::coupling
