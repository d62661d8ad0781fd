#pragma once
/// Priors of parameters. A parameter is sampled in a coordinate: its value, or its logarithm.

#include <limits>
#include <string>

#include "core/numbers/random.hpp"

namespace acinus::runs {

struct Prior {
  bool log = false;     ///< the coordinate is the natural logarithm of the value
  bool normal = false;  ///< normal in the coordinate, cut off at the bounds; else uniform
  double low = -std::numeric_limits<double>::infinity();  ///< bounds of the coordinate
  double high = std::numeric_limits<double>::infinity();
  double mean = 0, sd = 1;  ///< of a normal prior

  /// Density at a coordinate, up to a factor.
  double density(double x) const;
  double draw(UniformStream& random) const;
  /// Coordinate at `k` of `n` equal steps through the bounds, or 3 standard deviations to either
  /// side of the mean where these are closer.
  double step(int k, int n) const;
  double value(double x) const;       ///< value of the parameter at a coordinate
  double coordinate(double v) const;  ///< inverse of value()
};

}  // namespace acinus::runs
