#pragma once
/// Shortened steps. Where a computed displacement is rejected a part of it may do: cells then move
/// for part of the step with the velocity of the whole. Saves the solve of a retry. Of first order
/// like the step itself, since the velocity is that of an implicit step; too slow for what comes to
/// rest within the step, e.g. a node whose contact has snapped off.

#include "coupling/step/acceptance.hpp"

namespace acinus::coupling {

/// Smallest part of a computed step that is taken; below, a shorter step is computed.
inline constexpr double kLeastPart = 0.125;

/// Shortens the rejected displacement in work.move until it is acceptable.
///
/// Only linearly implicit steps with step-size control, without a prescribed velocity and without a
/// change of the random force within the step.
/// @param step        s, of the computed displacement
/// @param assessment  that of the displacement; on return of the shortened one
/// @return the part of the step that is taken; 1: the step was not shortened
double shorten_step(const World& world, double step, Workspace& work, Assessment& assessment);

}  // namespace acinus::coupling
