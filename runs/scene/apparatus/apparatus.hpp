#pragma once
/// List of the devices that a scene may have.

#include "coupling/world/world.hpp"
#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Shows a visitor the blocks of all devices. Those within other blocks are shown there.
void describe_apparatus(Visitor& visitor, Scene& scene);

/// Adds the broken rules of all devices. @pre called by check_rules
void check_apparatus(const Scene& scene, Report& report);

/// Adds the devices that the scene has. @pre cell types and their softened twins are set
void add_apparatus(const Scene& scene, coupling::Params& params);

}  // namespace acinus::runs
