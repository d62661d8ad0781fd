#pragma once
/// The life blocks of a scene as the world wants them.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Fills params.life. Types that dissolve get a softened twin each, added to the types' constants
/// and names.
/// @pre the constants of all types are there, in the order of scene.cell_types
void build_life(const Scene& scene, coupling::Params& params, std::vector<std::string>& type_names);

}  // namespace acinus::runs
