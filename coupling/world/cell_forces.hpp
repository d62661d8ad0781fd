#pragma once
/// Forces and frictions of whole cells.

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/row_vector.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

/// Forces on all cells, nN: [dcm lanes] and [cbm cells]. Spheres of other processes have none.
struct CellForces {
  std::vector<Vec3> dcm;
  RowVector<Vec3> cbm;
};

/// Friction of each cell with the medium, nN s/um.
struct MediumFriction {
  std::vector<double> dcm;  ///< negative if another process computes it
  RowVector<double> cbm;
  /// [cbm cells] not 0: another process computes it; empty: none
  std::span<const std::uint8_t> ghost{};

  bool is_ghost(std::size_t sphere) const { return !ghost.empty() && ghost[sphere] != 0; }
};

}  // namespace acinus::coupling
