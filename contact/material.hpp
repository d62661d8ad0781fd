#pragma once
/// Material of what stands around the cells.

#include <limits>

namespace acinus::contact {

/// Elastic and adhesive constants of a surrounding surface.
struct Material {
  double adhesion = 0;                                     ///< nN/um
  double young = std::numeric_limits<double>::infinity();  ///< kPa
  double poisson = 0;
  bool mirror = false;  ///< stands for an equal cell on the other side: no adhesion, no friction
};

}  // namespace acinus::contact
