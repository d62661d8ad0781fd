#pragma once
/// Contacts that close within a step. A linearly implicit step knows of the repulsion only where
/// surfaces touch at the point of linearisation; those that close on the way would run into each
/// other and be pushed out by the next step only, or the step be rejected.

#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Gap of a contact at the end of the step just solved, by its normal at the point of
/// linearisation, um.
double gap_after(const Workspace& work, const solve::Link& link);

/// How far a contact whose gap ends at `end` is from its repulsive branch then, um.
inline double clearance_at(double end, const solve::Link& link, const solve::LinkLoad& load) {
  return end + load.clearance - static_cast<double>(link.gap);
}

/// Largest depth by which a contact may be closed at the end of a step with step-size control, um.
inline constexpr double kControlledDepth = 0.2;

/// Where a contact that was open ends deeper than kControlledDepth: gives all open contacts that
/// end closed the repulsive branch of their law, p = -k gap, exact at the end of the step, and
/// gives those that end open after all their own law back; the system then is one Newton iteration
/// on (a change of the active set). Adds the changed forces to the system and prepares the operator
/// anew.
/// @return whether anything changed: the step has to be solved again
bool activate_closing(Workspace& work);

/// Whether a contact that was given its repulsive branch ends open and pulls. @pre the step was
/// solved
bool pulls_open(const Workspace& work);

}  // namespace acinus::coupling
