#pragma once
/// Fit of the law with which compressed spheres exert the forces of compressed deformable cells.

#include <string>
#include <vector>

#include "calibration/compression.hpp"
#include "calibration/curve.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

struct FitOptions {
  double highest = 0.2;     ///< largest d of the fit
  double power = 4;         ///< of the leading term
  bool free_power = false;  ///< fit the power as well
  /// Relative error above which the law becomes a table. [VanLiedekerke2020] has one term.
  double good_enough = 0.1;
};

/// Form of the law, with its errors.
struct FitAttempt {
  std::string form;  ///< "a0 + a1 d^4"
  Law law;
  double pointwise = 0;  ///< rms of the relative error at single points
};

/// Least squares on the mean force of the inner cells over the loaded snapshots of a compression,
/// with spheres in the places of the deformable cells: same places, hence same d, by the spheres'
/// own law. First the leading term with the a0 of the spheres; if its error exceeds good_enough, a
/// table of moduli. rms_relative is the rms of the difference over the rms of the force; the
/// interval of a1 is that of least squares at 95 %, from the scatter about the first form.
/// Law::jkr_underestimation is for the most compressed snapshots. Law::dcm, cbm and provenance are
/// left empty, warnings too.
/// @param sphere  constants of the spheres; young is a0
/// @return all forms tried, the one to use last
/// @throws Error(kCannotContinue) where the compression has hardly any load, or no law with a
/// positive a1 fits
std::vector<FitAttempt> fit_law(const Compression& compression, const cbm::Params& sphere,
                                const FitOptions& options);

/// Relative error: rms of (spheres - target) over rms of target, at 40 overlaps at equal distances
/// up to `highest` that both curves cover. NaN if there are none.
double relative_error(const ForceCurve& target, const ForceCurve& spheres, double highest);

}  // namespace acinus::calibration
