#pragma once
/// How far one cell of a clump is pressed into its neighbours, and how hard.

#include <span>
#include <vector>

#include "coupling/measure/measure.hpp"

namespace acinus::calibration {

struct ClumpSample {
  double overlap = 0;  ///< relative overlap d of the cell, as spheres have it
  /// Mean of 1 - |x_i - x_j| / (R_i + R_j) over the 14 cells nearest to it, neighbours and next
  /// neighbours of a body-centred lattice: unlike d it does not jump when a cell parts.
  double shell_overlap = 0;
  double force = 0;          ///< nN, sum of the normal forces of its contacts, pressing positive
  double contact_force = 0;  ///< nN, sum of the sizes of the forces on it
  double contacts = 0;       ///< cells it touches
  double pressure = 0;       ///< kPa, its contact pressure
  double volume = 0;         ///< its volume over the reference volume
};

/// Index of the cell nearest to a point. @pre there is a cell
std::size_t find_central_cell(std::span<const coupling::CellMeasure> cells, const Vec3& point);

/// d and shell overlap come from centres and reference radii alone, alike for both models.
ClumpSample measure_clump(std::span<const coupling::CellMeasure> cells, std::size_t cell);

}  // namespace acinus::calibration
