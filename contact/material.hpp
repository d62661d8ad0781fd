#pragma once
/// Material of obstacles.

#include <limits>

namespace acinus::contact {

/// Elastic and adhesive constants of an obstacle.
struct Material {
  double adhesion = 0;                                     ///< nN/um
  double young = std::numeric_limits<double>::infinity();  ///< kPa
  double poisson = 0;
  bool mirror = false;  ///< stands for an equal cell on the other side: no adhesion, no friction
};

/// Material of vessels, that of sinusoids.  [VanLiedekerke2020, Table 1]
inline constexpr Material kVesselMaterial{.young = 0.6, .poisson = 0.4};

}  // namespace acinus::contact
