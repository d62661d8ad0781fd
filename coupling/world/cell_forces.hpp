#pragma once
/// Forces and frictions of whole cells.

#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

/// Forces on all cells, nN: [dcm lanes] and [cbm cells].
struct CellForces {
  std::vector<Vec3> dcm, cbm;
};

/// Friction of each cell with the medium, nN s/um; negative if another process computes it.
struct MediumFriction {
  std::vector<double> dcm, cbm;
};

}  // namespace acinus::coupling
