#pragma once
/// Stage 7 of a step: acceptance or rejection of a computed displacement. Accepted displacements
/// are finite and small enough, invert no face and drive no contact deep.

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct Assessment {
  bool accepted = true;
  std::string cause;                ///< cause of rejection
  std::vector<std::int64_t> cells;  ///< lineages of the cells that caused it
  double usable = 0;                ///< part of a rejected displacement to try; 0: none
  double error = 0;                 ///< um, estimated error
  double max_move = 0;              ///< um, largest displacement
  double excess = 0;                ///< largest ratio of a displacement to its limit
};

/// Largest displacement of a cell in one step, um: max_move mean edges of its mesh; for a sphere
/// those of a 162-node mesh of its radius. Infinite if max_move is 0.
double move_limit(double max_move, double mean_edge);
inline constexpr double kSphereEdge = 0.3;  ///< mean edge of a 162-node mesh, in radii

/// Share of the largest displacement that a shortened step takes and the next step aims at.
inline constexpr double kMoveShare = 0.95;

/// The next step aims at kErrorShare of the length whose estimated error would be the tolerance.
/// The error is kErrorAim tolerances then.
inline constexpr double kErrorShare = 0.9, kErrorAim = kErrorShare * kErrorShare;

/// Largest estimated error of an accepted step, in tolerances, with step-size control.
inline constexpr double kMostError = 4;

/// Lanes of own cells that reject a step or make the next one shorter: they are displaced beyond
/// kMoveShare of their limit, exceed kErrorAim, have faces that turn over or contacts that end too
/// deep.
std::vector<std::size_t> find_limiting_cells(const World& world, double step, Workspace& work);

/// Accepts or rejects the displacement in work.move. Late cells are left out. Counts failed solves.
/// @param step    s, length of the step
/// @param part    its share of the step that was computed (shorten.hpp); 1: all of it. If the
///                velocity changes steadily the error of a part is (2 - part) times its estimate.
/// @param solved  outcome of the solver
Assessment assess_step(const World& world, double step, double part, const Status& solved,
                       Workspace& work);

}  // namespace acinus::coupling
