#pragma once
/// Work that a run omits because its scene does not need it.

#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Names of the terms and stages that the scene does not use.
std::vector<std::string> list_skipped(const coupling::World& world);

/// Work found unnecessary at run time so far, with its share.
std::vector<std::string> list_skipped_work(const coupling::World& world,
                                           const coupling::Workspace& work);

}  // namespace acinus::runs
