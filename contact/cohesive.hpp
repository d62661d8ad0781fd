#pragma once
/// Cohesive potential: traction between two surfaces as a function of their gap.

#include <algorithm>

namespace acinus::contact {

/// Constants of the cohesive potential phi, fJ/um^2, as a function of the gap d:
///   phi(d <= 0) = -W + 1/2 k d^2;  0 < d < range, u = d/range: phi = -W (1-u)^3 (1+3u);  0 beyond.
/// The area under the traction is W exactly; the traction vanishes at d = 0, where the normal of a
/// closest point is undefined. Continuous with its first derivative.
struct CohesiveLaw {
  double adhesion = 0;   ///< W, nN/um
  double repulsion = 0;  ///< k, nN/um^3
  double range = 1;      ///< um
};

/// Energy per area phi, fJ/um^2.
inline double cohesive_energy(const CohesiveLaw& w, double gap) {
  if (gap <= 0) return -w.adhesion + 0.5 * w.repulsion * gap * gap;
  if (gap >= w.range) return 0;
  const double u = gap / w.range, v = 1 - u;
  return -w.adhesion * v * v * v * (1 + 3 * u);
}

/// Traction d phi / d gap, kPa: positive pulls the surfaces together.
inline double cohesive_traction(const CohesiveLaw& w, double gap) {
  if (gap <= 0) return w.repulsion * gap;
  if (gap >= w.range) return 0;
  const double u = gap / w.range, v = 1 - u;
  return w.adhesion / w.range * 12 * u * v * v;
}

/// Stiffness max(0, d2 phi / d gap^2), nN/um^3: the softening branch is left out of the matrix.
inline double cohesive_stiffness(const CohesiveLaw& w, double gap) {
  if (gap <= 0) return w.repulsion;
  if (gap >= w.range) return 0;
  const double u = gap / w.range;
  return std::max(0.0, w.adhesion / (w.range * w.range) * 12 * (1 - u) * (1 - 3 * u));
}

/// Share of an area that counts as in contact: 1 up to half the range, smoothly falling to 0 at the
/// range.
inline double contact_share(double gap, double range) {
  if (gap <= 0.5 * range) return 1;
  if (gap >= range) return 0;
  const double s = 2 * gap / range - 1;
  return 1 - s * s * (3 - 2 * s);
}

}  // namespace acinus::contact
