#pragma once
/// Constants of cells while they dissolve.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Cell type during lysis: its constants that soften (Key::softens), times type.softening.
CellType softened(const CellType& type);

}  // namespace acinus::runs
