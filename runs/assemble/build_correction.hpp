#pragma once
/// Laws that correct the stiffness of spheres: from the scene's key to the constants of a run.

#include <string>
#include <vector>

#include "calibration/law.hpp"
#include "coupling/world/world.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Every constant of a cell type that a calibrated law depends on (Key::in_law).
struct LawParameters {
  calibration::Parameters dcm, cbm;
};
LawParameters law_parameters(const Scene& scene, const CellType& type);

/// Reads the law of every cell type that names one. A law's a0 is the type's modulus from then on.
/// Notes say which law, and warn where it was found for other cells.
/// @throws Error for a law file that cannot be used, and for "auto" (calibrated before, see
/// calibrate_scene.hpp)
void build_corrections(const Scene& scene, std::vector<cbm::Params>& params, Notes& notes);

}  // namespace acinus::runs
