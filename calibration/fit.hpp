#pragma once
/// Finds the law that makes squeezed spheres push as squeezed deformable cells do.

#include <functional>
#include <string>
#include <vector>

#include "calibration/curve.hpp"
#include "calibration/law.hpp"

namespace acinus::calibration {

struct FitOptions {
  double highest = 0.2;       ///< largest d that counts
  double power = 4;           ///< of the leading term
  bool free_modulus = false;  ///< fit a0 as well
  bool free_power = false;    ///< fit the power as well
  /// Relative error above which the law gets further terms. [VanLiedekerke2020] has one term.
  double good_enough = 0.1;
};

/// One form of the law and how well it does.
struct FitAttempt {
  std::string form;  ///< "a0 + a1 d^4"
  Law law;
  double pointwise = 0;  ///< rms of the relative error point by point
};

/// Squeezes the clump of spheres with this law and modulus a0 (kPa); its loading branch.
using SqueezeSpheres = std::function<Curve(const cbm::StiffnessLaw& law, double a0)>;

/// Least squares on the force over 40 overlaps at equal distances, over the spheres' own squeeze:
/// they carry the same force at the same d by their own law, d and neighbours. First the leading
/// term alone; while the error exceeds good_enough, terms d^4, d^6 and then d^8 join it, with a1 as
/// found before. rms_relative is the rms of the difference over the rms of the force; the interval
/// of a1 is that of least squares at 95 %, from the scatter about the first form.
/// Law::dcm, cbm and provenance are left empty.
/// @param a0  kPa, modulus of the spheres
/// @return all forms tried, the one to use last
/// @throws Error(kCannotContinue) where the curves have no overlap in common, or no law with a
/// positive a1 fits
std::vector<FitAttempt> fit_law(const Curve& target, double a0, const SqueezeSpheres& squeeze,
                                const FitOptions& options);

/// rms of (spheres - target) over rms of target, at n overlaps at equal distances up to `highest`.
double relative_error(const Curve& target, const Curve& spheres, double highest, int n = 40);

}  // namespace acinus::calibration
