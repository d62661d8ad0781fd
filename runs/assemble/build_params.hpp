#pragma once
/// Constants of a scene in the types that the models use.

#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Constants of one cell type in both models, without stiffness corrections.
dcm::Params make_dcm_params(const Scene& scene, const CellType& type);
cbm::Params make_cbm_params(const Scene& scene, const CellType& type);

/// Contact, friction, start-up, migration, numerics and devices. @pre the cell types are set
void set_params(const Scene& scene, coupling::Params& params);

}  // namespace acinus::runs
