#pragma once
/// Cells that rest in balance are left out of the step until something pushes them.
///
/// A cell falls asleep when it does not grow and the force on it is out of balance by less than a
/// traction, and wakes when it is out of balance by more. Balance is looked at on a time
/// grid, with all loads of all cells as if none slept; from there to the next look a sleeper
/// goes on with the velocity of one long step (partial_step.hpp), a constraint for cells awake.
/// (docs/decisions/0015.md)

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Root mean square over a cell's surface of the force out of balance per area, kPa; [dcm lanes,
/// then cbm cells].   @pre observe(world, work)
std::vector<double> unbalanced_traction(const World& world, const Workspace& work);

/// Puts cells to sleep and wakes others if the time grid was crossed.
/// @return false if the process is asked to stop meanwhile: then nothing has changed
[[nodiscard]] bool update_sleep(World& world, Workspace& work);

/// Time until sleep is looked at again, s; infinite when no cell may sleep.
double time_to_sleep_event(const World& world);

}  // namespace acinus::coupling
