#pragma once
/// A clump that is compressed, snapshot by snapshot, and what its inner cells bear on average.

#include <limits>
#include <vector>

#include "calibration/curve.hpp"
#include "cbm/params.hpp"
#include "core/vec.hpp"

namespace acinus::calibration {

/// The cells of a clump at one time.
struct ClumpSnapshot {
  std::vector<Vec3> center;    ///< um
  std::vector<double> radius;  ///< um, reference radii
  std::vector<double> force;   ///< nN, as ClumpSample::force, of each cell
  /// um, of the capsule round the middle
  double capsule = std::numeric_limits<double>::infinity();
};

struct Compression {
  std::vector<ClumpSnapshot> snapshots;  ///< over time
  std::vector<std::size_t> inner;  ///< cells that stand for tissue: all but those at the capsule
};

/// Means over the inner cells. One cell says little: at one pressure d differs from cell to cell by
/// a tenth, and by more between the middle, a lattice still, and the rest.
struct Bulk {
  double overlap = 0;  ///< d, as spheres have it
  double force = 0;    ///< nN, as ClumpSample::force
};

/// Cells farther than 1.25 radii from the capsule when the clump presses with a tenth of its
/// largest force: later some of them come near it, too. Where there are none, as in a clump of 15,
/// the one nearest the middle.
/// @param point  um, middle of the capsule
std::vector<std::size_t> find_inner_cells(const std::vector<ClumpSnapshot>& snapshots,
                                          const Vec3& point);

Bulk measure_bulk(const ClumpSnapshot& snapshot, const std::vector<std::size_t>& inner);

/// That of every snapshot.
std::vector<Bulk> measure_bulks(const std::vector<ClumpSnapshot>& snapshots,
                                const std::vector<std::size_t>& inner);

/// Force over overlap of the inner cells, from where overlaps rise without a break.
ForceCurve force_curve(const std::vector<ClumpSnapshot>& snapshots,
                       const std::vector<std::size_t>& inner);

/// Indices of the snapshots that press, with a hundredth of the largest force or more, at an
/// overlap up to `highest`.
std::vector<std::size_t> find_pressing(const std::vector<Bulk>& bulks, double highest);

/// The forces that spheres in the places of the cells feel by their contact law. The inner ones
/// have the modulus of their own d, the others, whose d the capsule disturbs, that of the mean.
ClumpSnapshot as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                         const std::vector<std::size_t>& inner);

/// The bulk of those spheres.
Bulk bulk_as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                     const std::vector<std::size_t>& inner);

}  // namespace acinus::calibration
