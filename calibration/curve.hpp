#pragma once
/// Contact force over overlap, as a clump that is compressed gives it.

#include <span>
#include <vector>

namespace acinus::calibration {

/// Normal force over relative overlap d, means over the inner cells of a clump.
struct ForceCurve {
  std::vector<double> overlap;  ///< strictly ascending
  std::vector<double> force;    ///< nN
  bool empty() const { return overlap.empty(); }
};

/// The last stretch of a history on which d rises without a break up to its largest value. Before
/// it cells settle and find new neighbours, and d says little about the force.
/// @param overlap, force  [n] over time, all finite
ForceCurve loading_branch(std::span<const double> overlap, std::span<const double> force);

/// Force at d, linear between the points. @pre d within the curve
double force_at(const ForceCurve& curve, double overlap);

/// Place in a history, between its entries, at which it last rises through a value. NaN: nowhere.
double find_last_rise(std::span<const double> history, double value);

/// n overlaps at equal distances over what all curves cover, at most up to `highest`. Empty if they
/// have no overlap in common.
std::vector<double> common_overlaps(std::span<const ForceCurve* const> curves, double highest,
                                    int n);

}  // namespace acinus::calibration
