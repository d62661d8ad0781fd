#pragma once
/// Events between steps: entry into and exit from the cell cycle, division and death.

#include <cstdint>
#include <span>
#include <string>

#include "coupling/life/life_report.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Stage 8 of a step: applies rules and inhibition on their time grid, divides cells that have
/// doubled their reference volume, and removes dead cells. Sizes the workspace anew if the set of
/// cells changed. Then updates sleep (sleep.hpp) and zoom (zoom/update.hpp), and repairs degenerate
/// meshes (mesh_health.hpp). The clock does not advance.
LifeReport live(World& world, Workspace& work);

/// Removes those of the cells that are in lysis. Their membrane softens to the end, so a step that
/// fails at them ends their lysis, not the run.
/// @param why  cause of the failure
/// @return empty if none of them is in lysis
LifeReport remove_dying(World& world, Workspace& work, std::span<const std::int64_t> cells,
                        const std::string& why);

/// Time to the next point on the grids of rules, sleep and zoom, s, where a step has to end;
/// infinite without any. Division, removal and mesh repair are checked after every step.
double time_to_event(const World& world);

}  // namespace acinus::coupling
