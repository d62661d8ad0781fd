#pragma once
/// Sleep: cells in balance are left out of the step until forces wake them.
///
/// A cell falls asleep if it does not grow and its residual force per area is below a threshold; it
/// wakes above. The balance is evaluated on a time grid, with all loads of all cells as if none
/// slept. Until the next evaluation a sleeper keeps the velocity of one long step
/// (partial_step.hpp), a constraint for awake cells (decision 15).

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Root mean square over the surface of a cell of the residual force per area, kPa; [dcm lanes,
/// then cbm cells].   @pre observe(world, work)
std::vector<double> unbalanced_traction(const World& world, const Workspace& work);

/// Updates sleeping and awake cells if the time grid was crossed.
/// @return false if the process is asked to stop; nothing has changed then
[[nodiscard]] bool update_sleep(World& world, Workspace& work);

/// Wakes all cells until the next update of sleep, for a sudden change of what holds them.
void wake_all(World& world);

/// Time to the next update of sleep, s; infinite if no cell may sleep.
double time_to_sleep_event(const World& world);

}  // namespace acinus::coupling
