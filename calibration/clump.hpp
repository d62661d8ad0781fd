#pragma once
/// Overlap and contact force of one cell of a clump.

#include <span>
#include <vector>

#include "coupling/measure/measure.hpp"

namespace acinus::calibration {

struct ClumpSample {
  double overlap = 0;  ///< relative overlap d of the cell, as for spheres
  /// Mean of 1 - |x_i - x_j| / (R_i + R_j) over the 14 cells nearest to it, neighbours and next
  /// neighbours of a body-centred lattice: unlike d it does not jump when a contact opens.
  double shell_overlap = 0;
  double force = 0;          ///< nN, sum of the normal forces of its contacts, compression positive
  double contact_force = 0;  ///< nN, sum of the magnitudes of the forces on it
  double contacts = 0;       ///< number of cells in contact with it
  double pressure = 0;       ///< kPa, mean contact pressure
  double volume = 0;         ///< ratio of its volume to the reference volume
};

/// Index of the cell nearest to a point. @pre there is a cell
std::size_t find_central_cell(std::span<const coupling::CellMeasure> cells, const Vec3& point);

/// Measures one cell. d and shell overlap follow from centres and reference radii alone, alike for
/// both models.
ClumpSample measure_clump(std::span<const coupling::CellMeasure> cells, std::size_t cell);

}  // namespace acinus::calibration
