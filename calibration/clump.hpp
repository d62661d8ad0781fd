#pragma once
/// What calibration looks at in a clump of cells: how far the central cell and its neighbours are
/// pressed into each other, and how hard.

#include <limits>
#include <span>
#include <vector>

#include "coupling/measure.hpp"
#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::calibration {

struct ClumpSample {
  double overlap = 0;  ///< relative overlap d of the central cell, as spheres have it
  /// Mean of 1 - |x_i - x_j| / (R_i + R_j) over the 14 cells nearest the central one, neighbours
  /// and next neighbours of a body-centred lattice: unlike d it does not jump when a cell parts.
  double shell_overlap = 0;
  double force = 0;          ///< nN, sum of the normal forces of its contacts, pressing positive
  double contact_force = 0;  ///< nN, sum of the sizes of the forces on it
  double contacts = 0;       ///< cells it touches
  double pressure = 0;       ///< kPa, its contact pressure
  double volume = 0;         ///< its volume over the reference volume
};

/// A clump at one moment of a squeeze of deformable cells.
struct Moment {
  std::vector<Vec3> center;    ///< um
  std::vector<double> radius;  ///< um, reference radii
  double force = 0;            ///< nN, as ClumpSample::force
  /// um, of the capsule round the middle: outer cells feel how full their room is by it as well
  double capsule = std::numeric_limits<double>::infinity();
};

/// Index of the cell nearest to a point. @pre there is a cell
std::size_t find_central_cell(std::span<const coupling::CellMeasure> cells, const Vec3& point);

/// d and shell overlap come from centres and reference radii alone, alike for both models.
ClumpSample measure_clump(std::span<const coupling::CellMeasure> cells, std::size_t central);

/// Every cell of this moment.
std::vector<coupling::CellMeasure> observe_cells(const coupling::World& world,
                                                 coupling::Workspace& work);

/// Steps until clock.time is `time`, with the tissue only: no birth, death or look of any rule.
/// @throws Error(kCannotContinue) when a step fails
void advance_to(coupling::World& world, coupling::Workspace& work, double time);

/// Spheres in the places of the cells of a moment: what the cell nearest `point` feels by the
/// contact law of spheres, with their own d.
ClumpSample measure_as_spheres(const Moment& moment, const cbm::Params& sphere, const Vec3& point);

}  // namespace acinus::calibration
