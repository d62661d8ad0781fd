#pragma once
/// Curve of contact force over overlap of a compressed clump.

#include <span>
#include <vector>

namespace acinus::calibration {

/// Normal force over relative overlap d, means over the inner cells of a clump.
struct ForceCurve {
  std::vector<double> overlap;  ///< strictly ascending
  std::vector<double> force;    ///< nN
  bool empty() const { return overlap.empty(); }
};

/// Loading branch of a history: the last stretch on which d only rises, up to its largest value.
/// Before it cells rearrange, and d does not determine the force.
/// @param overlap, force  [n] over time, all finite
ForceCurve loading_branch(std::span<const double> overlap, std::span<const double> force);

/// Force at d, linear between the points. @pre d within the curve
double force_at(const ForceCurve& curve, double overlap);

/// Position in a history, between its entries, of its last rise through a value. NaN: none.
double find_last_rise(std::span<const double> history, double value);

/// Overlaps at n equal distances over the range that all curves cover, at most up to `highest`.
/// Empty if they have no overlap in common.
std::vector<double> common_overlaps(std::span<const ForceCurve* const> curves, double highest,
                                    int n);

}  // namespace acinus::calibration
