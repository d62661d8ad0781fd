#pragma once
/// The constants of the terms of a deformable cell, as its scene gives them: what softening scales
/// and what a law of spheres depends on.

#include "calibration/law.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// The cell type while its cells dissolve: what softens, times type.softening.
CellType softened(const CellType& type);

/// The constants of all terms by name with unit, as law files have them.
calibration::Parameters term_constants(const DcmBlock& cell);

}  // namespace acinus::runs
