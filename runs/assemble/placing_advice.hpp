#pragma once
/// Advice for scenes whose cells start too close to each other.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Changes of the scene that let cells start small or newborn, as far as they apply.
/// @pre no start-up phase
std::vector<std::string> list_smaller_starts(const Scene& scene);

/// Change of the scene that places its cells farther apart.
std::string advise_spacing(const Scene& scene);

}  // namespace acinus::runs
