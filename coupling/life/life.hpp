#pragma once
/// The events between steps: cells enter and leave their cycle, divide and die.

#include <cstdint>
#include <span>
#include <string>

#include "coupling/life/life_report.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Stage 8 of a step: applies rules and inhibition on their time grid, then divides what has
/// doubled its reference volume and removes what is dead. Time stands still. The workspace is sized
/// anew when the set of cells changed. Then puts cells to sleep or wakes them (sleep.hpp), lets the
/// zoom follow (zoom/update.hpp), and mends meshes that degenerate (mesh_health.hpp).
LifeReport live(World& world, Workspace& work);

/// Removes those of the cells that dissolve. Their membrane gives way to the last, so a step that
/// fails at them ends what is left of them, not the run.
/// @param why  as the step said it
/// @return without events: none of them dissolves
LifeReport remove_dying(World& world, Workspace& work, std::span<const std::int64_t> cells,
                        const std::string& why);

/// Time to the next point on the grids of rules, sleep and zoom, at which a step has to end, s;
/// infinite without any. Division, removal and mesh repair are looked for after every step.
double time_to_event(const World& world);

}  // namespace acinus::coupling
