#pragma once
/// What a run leaves out because its scene does not need it.

#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

/// What the scene does not ask for.
std::vector<std::string> list_skipped(const coupling::World& world);

/// Work that turned out not to be needed, with shares, so far.
std::vector<std::string> list_skipped_work(const coupling::World& world,
                                           const coupling::Workspace& work);

}  // namespace acinus::runs
