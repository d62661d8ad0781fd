#pragma once
/// Tension of cortex springs that stand in series with a dashpot: it depends on the past, so it is
/// state.

#include <vector>

namespace acinus::dcm {

/// Of one cell.
struct EdgeTension {
  std::vector<double> force;   ///< [n_edge] nN, pulls both nodes together; empty: no tension yet
  std::vector<double> length;  ///< [n_edge] um, of the edges when that was

  bool is_new() const { return force.empty(); }
};

/// How a spring k in series with a dashpot g goes through a step h in which its length changes at a
/// constant rate: f(t+h) = kept f(t) + share k (l(t+h) - l(t)). That is exact for any h:
/// (df/dt) / k + f / g = dl/dt.   [VanLiedekerke2020, Eq. (5) and (6), as scalars along the edge
/// and with the sign that makes the dashpot lose energy; docs/models.md]
struct SeriesStep {
  double kept = 1;   ///< exp(-q), q = k h / g
  double share = 1;  ///< (1 - exp(-q)) / q
};

/// @param stiffness  nN/um
/// @param friction   nN s/um, > 0
/// @param step       s; 0: nothing happens yet
SeriesStep series_step(double stiffness, double friction, double step);

}  // namespace acinus::dcm
