#pragma once
/// Fields of substances of a scene.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Sets the constants of substances and their fields at t = 0.
/// @param world  with its cells and boundary
/// @param notes  receives the size of the grid
/// @throws Error if a cell starts outside the box, or the grid needs more memory than there is
void build_substances(const Scene& scene, coupling::World& world, Notes& notes);

/// Memory of fields and their solver, bytes.
double substance_memory(double n_voxel, const std::vector<SubstanceBlock>& substances);

/// Lineages of the cells with their centre outside the box of the fields.
std::vector<std::int64_t> find_cells_outside_fields(const coupling::World& world);

}  // namespace acinus::runs
