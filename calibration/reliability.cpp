#include "calibration/reliability.hpp"

#include <fmt/format.h>

#include <cmath>

namespace acinus::calibration {

std::vector<std::string> list_warnings(int n_inner, double error) {
  std::vector<std::string> warnings;
  if (n_inner < kFewestInner)
    warnings.push_back(
        fmt::format("cells that are not at the capsule: {}; at least {} are needed. Their mean "
                    "knows the modulus "
                    "to a factor of {:.1f} at best. Take a larger clump (--cells 59)",
                    n_inner, kFewestInner, std::exp2(1 / std::sqrt(n_inner))));
  if (!std::isfinite(error)) {
    warnings.emplace_back(
        "spheres with this law, compressed by themselves, never come to the overlaps of the "
        "deformable cells. Take another clump (--cells) or compress less far (--highest)");
  } else if (error > kLargestError) {
    warnings.push_back(fmt::format(
        "spheres with this law, compressed by themselves, are {:.0f} % off the deformable cells; "
        "more than {:.0f} % says that the law does not hold outside its fit. Take a larger clump "
        "(--cells 59) or fit less far (--highest)",
        100 * error, 100 * kLargestError));
  }
  return warnings;
}

}  // namespace acinus::calibration
