#pragma once
/// Active set of contacts: those that close within a step. A linearly implicit step has repulsion
/// only in contacts that are closed at the point of linearisation. Contacts that close during the
/// step would overlap until the next step, or cause a rejected step.

#include "coupling/step/effort.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Gap of a contact at the end of the step just solved, along its normal at the point of
/// linearisation, um.
double gap_after(const Workspace& work, const solve::Link& link);

/// Clearance of a contact from its repulsive branch at a gap of `end`, um; negative: depth.
inline double clearance_at(double end, const solve::Link& link, const solve::ClosedLaw& law) {
  return end + law.clearance - static_cast<double>(link.gap);
}

/// Largest depth of a contact that closes within a step with step-size control, um.
inline constexpr double kControlledDepth = 0.2;

/// Updates the active set after a solve: one further Newton iteration. If an open contact ends
/// deeper than kControlledDepth, all open contacts that end closed get the repulsive branch of
/// their law, p = -k gap, exact at the end of the step. Those that end open get their own law back.
/// Brings forces, right-hand side and residual of own points up to date, and products. Collective.
/// @return true if the set changed and the step has to be solved again
bool activate_closing(Workspace& work);

/// True if a contact on its repulsive branch ends open and pulls.
/// @pre the step was solved
bool pulls_open(const Workspace& work);

/// Alternates updates of the active set with solves until it no longer changes.   @pre the step was
/// solved
[[nodiscard]] Status settle_active_set(const World& world, Workspace& work, Effort& effort);

}  // namespace acinus::coupling
