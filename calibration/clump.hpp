#pragma once
/// What calibration looks at in a clump of cells: how far its central cell and its inner cells are
/// pressed into their neighbours, and how hard.

#include <limits>
#include <span>
#include <vector>

#include "coupling/measure/measure.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

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

/// A clump at one moment of a squeeze.
struct Moment {
  std::vector<Vec3> center;    ///< um
  std::vector<double> radius;  ///< um, reference radii
  std::vector<double> force;   ///< nN, as ClumpSample::force, of each cell
  /// um, of the capsule round the middle
  double capsule = std::numeric_limits<double>::infinity();
};

/// The history of a clump that is squeezed.
struct Squeeze {
  std::vector<Moment> moment;
  std::vector<std::size_t> inner;  ///< cells that stand for tissue: all but those at the capsule
};

/// Means over the inner cells of a squeeze. One cell says little: at one pressure d differs from
/// cell to cell by a tenth, and by more between the middle, a lattice still, and the rest.
struct Bulk {
  double overlap = 0;  ///< d, as spheres have it
  double force = 0;    ///< nN, as ClumpSample::force
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

/// Cells farther than 1.25 radii from the capsule when the clump presses with a tenth of its
/// largest force: later some of them come near it, too. Where there are none, as in a clump of 15,
/// the one nearest the middle.
/// @param point  um, middle of the capsule
std::vector<std::size_t> find_inner_cells(const std::vector<Moment>& history, const Vec3& point);

Bulk measure_bulk(const Moment& moment, const std::vector<std::size_t>& inner);

/// That of every moment.
std::vector<Bulk> measure_bulks(const std::vector<Moment>& history,
                                const std::vector<std::size_t>& inner);

/// Indices of the moments that press, with a hundredth of the largest force or more, at an overlap
/// up to `highest`.
std::vector<std::size_t> find_pressing(const std::vector<Bulk>& bulks, double highest);

/// The forces that spheres in the places of the cells feel by their contact law. The inner ones
/// have the modulus of their own d, the others, whose d the capsule disturbs, that of the mean.
Moment as_spheres(const Moment& moment, const cbm::Params& sphere,
                  const std::vector<std::size_t>& inner);

/// The bulk of those spheres.
Bulk bulk_as_spheres(const Moment& moment, const cbm::Params& sphere, const Squeeze& squeeze);

}  // namespace acinus::calibration
