#pragma once
/// Rules that never acted in a run.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Messages on inhibition that slowed no growth by 1 % in any frame, on rules by which no cell
/// died, and on rules by which no cell rested in any frame. Rules that begin later are left out.
/// Also on rules of signals that acted on no cell by half or more in any frame.
/// Collective.
/// @param measures  of all frames so far
/// @param time      reached, s since t = 0
std::vector<std::string> list_idle_rules(const Scene& scene, const Measures& measures,
                                         const coupling::World& world, double time);

}  // namespace acinus::runs
