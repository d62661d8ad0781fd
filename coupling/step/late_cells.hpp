#pragma once
/// Late cells: the few deformable cells that a step of the whole tissue is too long for, since they
/// move far or change their velocity. They take shorter steps of their own, while all others take
/// the whole step.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "coupling/step/acceptance.hpp"

namespace acinus::coupling {

/// Steps of late cells among the others (subworld/late_steps.hpp).
struct LateSteps {
  /// Advances late cells by a step, s; the others have the displacements work.move. False: failed.
  std::function<bool(double step, std::span<const std::size_t> lanes)> advance;
  /// Writes their points to the state at the end of the step.
  std::function<void()> write;
};

/// Largest share of the cells that are late together, so that their steps cost little.
inline constexpr double kMostLate = 0.01;

/// Lanes of late cells, ascending: those that reject the displacement in work.move or make the next
/// step shorter (find_limiting_cells). None if spheres or more than kMostLate of the cells would be
/// late, if leaders or flexible vessels have to be computed with all cells, with a prescribed
/// velocity, and with other than linearly implicit steps under step-size control. Collective.
/// @param assessment  of the displacement
std::vector<std::size_t> find_late_cells(const World& world, double step,
                                         const Assessment& assessment, Workspace& work);

/// Marks late cells, which assess_step() and the estimated error leave out from then on.
void mark_late(std::span<const std::size_t> lanes, Workspace& work);

}  // namespace acinus::coupling
