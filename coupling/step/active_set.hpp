#pragma once
/// Active set of contacts: those that close within a step. A linearly implicit step has repulsion
/// only where surfaces touch at the point of linearisation; those that close on the way would run
/// into each other and be pushed out by the next step only, or the step be rejected.

#include "coupling/step/effort.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Gap of a contact at the end of the step just solved, by its normal at the point of
/// linearisation, um.
double gap_after(const Workspace& work, const solve::Link& link);

/// Distance, um, of a contact whose gap ends at `end` from its repulsive branch; negative: depth.
inline double clearance_at(double end, const solve::Link& link, const solve::LinkLoad& load) {
  return end + load.clearance - static_cast<double>(link.gap);
}

/// Largest depth by which a contact may be closed at the end of a step with step-size control, um.
inline constexpr double kControlledDepth = 0.2;

/// Changes the active set of the step just solved. If a contact that was open ends deeper than
/// kControlledDepth, all open contacts that end closed get the repulsive branch of their law, p =
/// -k gap, exact at the end of the step, and those that end open after all get their own law back:
/// one Newton iteration on. Adds the changed forces to the system and prepares the operator anew.
/// @return true if anything changed: the step has to be solved again
bool activate_closing(Workspace& work);

/// True if a contact that was given its repulsive branch ends open and pulls.
/// @pre the step was solved
bool pulls_open(const Workspace& work);

/// Changes the active set and solves again until it holds.   @pre the step was solved
[[nodiscard]] Status settle_active_set(const World& world, Workspace& work, Effort& effort);

}  // namespace acinus::coupling
