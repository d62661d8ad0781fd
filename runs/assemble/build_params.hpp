#pragma once
/// Physical and numerical constants of a scene in the parameter types of the models.

#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Constants of one cell type as a deformable cell and as a sphere, without stiffness corrections.
dcm::Params make_dcm_params(const Scene& scene, const CellType& type);
cbm::Params make_cbm_params(const Scene& scene, const CellType& type);

/// Sets contact, friction, start-up, migration, zoom, apparatus and numerics.
void set_params(const Scene& scene, coupling::Params& params);

}  // namespace acinus::runs
