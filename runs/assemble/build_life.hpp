#pragma once
/// Parameters of growth, division, death and sleep from the life blocks of a scene.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Fills params.life and params.sleep. Every cell type with lysis gets a softened twin for its
/// dissolving cells, appended to the constants and names of the types.
/// @pre the constants of all types are there, in the order of scene.cell_types
void build_life(const Scene& scene, coupling::Params& params, std::vector<std::string>& type_names);

}  // namespace acinus::runs
