#pragma once
/// State at t = 0 as a file for other runs, which share one start-up phase.

#include <string>

#include "coupling/world/world.hpp"
#include "runs/assemble/check_state.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Writes <folder>/start.h5. Called at t = 0, after start-up and before the life events begin.
/// @throws Error(kFileError)
void save_start(const std::string& folder, const Scene& scene, const coupling::World& world);

/// Replaces cells and clock of a world by the state at t = 0 of the run in scene.start_up.from.
/// Growth, motility, friction and output may differ from that run; keys that shape the start must
/// not.
/// @return note for the log
/// @throws Error(kBadInput) naming the keys that differ, Error(kFileError) for a damaged file
std::string take_start(const Scene& scene, const StateTypes& types, coupling::State& state);

/// True if a key may differ between this scene and that of the run it starts from. Cells with a
/// random age have its size at the start, so their cycle must be the same.
/// @param pointer  JSON pointer of the key in a canonical scene
bool may_differ_at_start(const Scene& scene, const std::string& pointer);

}  // namespace acinus::runs
