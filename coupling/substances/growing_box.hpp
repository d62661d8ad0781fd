#pragma once
/// Box of the fields that grows with the tissue.
///
/// New layers of voxels have the concentration outside their face, so a field goes on as if the
/// medium there had been well mixed until then. Faces through which nothing passes stay.

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// True if the box grows at a face: every substance has a concentration outside it.
bool grows_at(const SubstanceParams& params, std::size_t face);

/// Sets the present grid to the first one with the layers of the state.
void place_fields(SubstanceParams& params, const State& state);

/// Adds layers at faces that are nearer to a cell than the margin. What new voxels hold counts as
/// entered through the faces. No effect if the box does not grow.
/// @param supply  [substance] factor on the concentrations outside
void grow_fields(World& world, const std::vector<double>& supply);

}  // namespace acinus::coupling
