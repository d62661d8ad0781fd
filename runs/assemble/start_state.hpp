#pragma once
/// The state at t = 0 as a file, for other runs to start from: start-up is paid once.

#include <string>

#include "coupling/world/world.hpp"
#include "runs/assemble/check_state.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Writes <folder>/start.h5. To be called at t = 0, after start-up and before life begins.
/// @throws Error(kFileError)
void save_start(const std::string& folder, const Scene& scene, const coupling::State& state);

/// Replaces the cells and the clock of a world by those that the run in scene.start_up.from had at
/// its t = 0. Growth, motility, friction and what is written may differ from that run; what shapes
/// the start must not.
/// @return what was done, for the log
/// @throws Error(kBadInput) naming the keys that differ, Error(kFileError) for a damaged file
std::string take_start(const Scene& scene, const StateTypes& types, coupling::State& state);

/// True for the pointer of a key that may differ between this scene and that of the run it starts
/// from (Affects). Cells that start at any age have its size, so their cycle must be the same.
bool may_differ_at_start(const Scene& scene, const std::string& pointer);

}  // namespace acinus::runs
