#pragma once
/// Stiffness corrections of spheres: from the law named in the scene to the constants of the run.

#include <string>
#include <vector>

#include "calibration/law.hpp"
#include "coupling/world/world.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Reads the stiffness law of every cell type that names one and enters it into its sphere
/// constants. The modulus of the spheres becomes a0 of the law.
/// @param params  [n_type], in the order of scene.cell_types
/// @param notes   receives the name of each law, and a warning if it was calibrated for other cells
/// @throws Error for an unusable law file, and for "auto" without a shipped law, which
/// resolve_corrections() replaces by a file first
void build_corrections(const Scene& scene, std::vector<cbm::Params>& params, Notes& notes);

}  // namespace acinus::runs
