#pragma once
/// Compression of a clump, snapshot by snapshot, and means over its inner cells.

#include <limits>
#include <vector>

#include "calibration/curve.hpp"
#include "cbm/params.hpp"
#include "core/vec.hpp"

namespace acinus::calibration {

/// Snapshot of the cells of a clump.
struct ClumpSnapshot {
  std::vector<Vec3> center;    ///< um
  std::vector<double> radius;  ///< um, reference radii
  std::vector<double> force;   ///< nN, as ClumpSample::force, of each cell
  /// Radius of the capsule round the centre, um.
  double capsule = std::numeric_limits<double>::infinity();
};

struct Compression {
  std::vector<ClumpSnapshot> snapshots;  ///< over time
  std::vector<std::size_t> inner;  ///< cells that represent tissue: all but those at the capsule
  /// Overlap of two such cells that adhere and are at rest, over the sum of their radii; 0: they do
  /// not adhere, or it is unknown.
  double pair_overlap = 0;
};

/// Means over the inner cells. A single cell is not enough: at one pressure d differs from cell to
/// cell by a tenth, and by more between the middle, still a lattice, and the rest.
struct Bulk {
  double overlap = 0;  ///< d, as for spheres
  double force = 0;    ///< nN, as ClumpSample::force
};

/// Cells farther than 1.25 radii from the capsule when the clump presses with a tenth of its
/// largest force: later some of them come near it, too. If there are none, as in a clump of 15, the
/// one nearest the centre.
/// @param point  um, centre of the capsule
std::vector<std::size_t> find_inner_cells(const std::vector<ClumpSnapshot>& snapshots,
                                          const Vec3& point);

Bulk measure_bulk(const ClumpSnapshot& snapshot, const std::vector<std::size_t>& inner);

/// Means over the inner cells in every snapshot.
std::vector<Bulk> measure_bulks(const std::vector<ClumpSnapshot>& snapshots,
                                const std::vector<std::size_t>& inner);

/// Force over overlap of the inner cells, on the part of the history where the overlap only rises.
ForceCurve force_curve(const std::vector<ClumpSnapshot>& snapshots,
                       const std::vector<std::size_t>& inner);

/// Indices of the snapshots under load, with a hundredth of the largest force or more, at an
/// overlap up to `highest`.
std::vector<std::size_t> find_pressing(const std::vector<Bulk>& bulks, double highest);

/// Snapshot with the contact forces of spheres in the places of the cells. The inner ones have the
/// modulus of their own d, the others, whose d the capsule disturbs, that of the mean.
ClumpSnapshot as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                         const std::vector<std::size_t>& inner);

/// Means over the inner cells of that snapshot.
Bulk bulk_as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                     const std::vector<std::size_t>& inner);

}  // namespace acinus::calibration
