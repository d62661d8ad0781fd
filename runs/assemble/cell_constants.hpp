#pragma once
/// Constants of the terms of a deformable cell: those scaled by softening and those a stiffness law
/// depends on.

#include "calibration/law.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Cell type during lysis: its softening constants and its adhesion, times type.softening.
CellType softened(const CellType& type);

/// Constants of all terms under their names in law files, which end in the unit.
calibration::Parameters term_constants(const DcmBlock& cell);

}  // namespace acinus::runs
