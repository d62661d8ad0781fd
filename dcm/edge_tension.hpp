#pragma once
/// Tension of cortex springs in series with a dashpot. It depends on history, so it is state.

#include <vector>

namespace acinus::dcm {

/// Tensions of the edges of one cell.
struct EdgeTension {
  std::vector<double> force;   ///< [n_edge] nN, pulls both nodes together; empty: no tension yet
  std::vector<double> length;  ///< [n_edge] um, of the edges at the time of `force`

  bool is_new() const { return force.empty(); }
};

/// Coefficients of a step h of a spring k in series with a dashpot g, with a length that changes at
/// a constant rate: f(t+h) = kept f(t) + share k (l(t+h) - l(t)). Exact for any h: (df/dt) / k + f
/// / g = dl/dt.   [VanLiedekerke2020, Eq. (5) and (6), as scalars along the edge and with the sign
/// that makes the dashpot dissipate energy; docs/science/models.md]
struct SeriesStep {
  double kept = 1;   ///< exp(-q), q = k h / g
  double share = 1;  ///< (1 - exp(-q)) / q
};

/// Coefficients of one step.
/// @param stiffness  nN/um
/// @param friction   nN s/um, > 0
/// @param step       s; 0: the tension stays as it is
SeriesStep series_step(double stiffness, double friction, double step);

}  // namespace acinus::dcm
