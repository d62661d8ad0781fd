#include "contact/hertz.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace acinus::contact {

namespace {

double reduced_modulus(const SphereBody& a, const SphereBody& b) {
  const double compliance =
      (1.0 - a.poisson * a.poisson) / a.young + (1.0 - b.poisson * b.poisson) / b.young;
  ACINUS_ASSERT(compliance > 0.0);
  return 1.0 / compliance;
}

}  // namespace

SpherePair reduced_pair(const SphereBody& a, const SphereBody& b, double adhesion) {
  const double curvature = 1.0 / a.radius + 1.0 / b.radius;
  ACINUS_ASSERT(curvature > 0.0 && adhesion >= 0.0);
  return {1.0 / curvature, reduced_modulus(a, b), adhesion};
}

SpherePair vessel_pair(const SphereBody& cell, const SphereBody& vessel, double adhesion) {
  ACINUS_ASSERT(cell.radius > 0.0 && vessel.radius > 0.0 && adhesion >= 0.0);
  const double across = 1.0 / (1.0 / cell.radius + 1.0 / vessel.radius);
  return {std::sqrt(across * cell.radius), reduced_modulus(cell, vessel), adhesion};
}

SphereForce hertz_force(const SpherePair& pair, double overlap) {
  if (overlap < 0.0) return {};
  const double a = std::sqrt(pair.radius * overlap);
  const double force_by_modulus = (4.0 / 3.0) * a * overlap;
  return {pair.modulus * force_by_modulus, a, 2.0 * pair.modulus * a, force_by_modulus, true};
}

SphereForce weaken(SphereForce law, double share) {
  if (share <= 0) return {};
  law.force *= share;
  law.stiffness *= share;
  law.force_by_modulus *= share;
  law.contact_radius *= std::sqrt(share);
  return law;
}

double hertz_energy(const SpherePair& pair, double overlap) {
  if (overlap < 0.0) return 0.0;
  return (8.0 / 15.0) * pair.modulus * std::sqrt(pair.radius * overlap) * overlap * overlap;
}

SphereForce mirror_wall_force(const SphereBody& cell, double height) {
  const SphereBody plane = {kFlat, kRigid, 0.0};
  return hertz_force(reduced_pair(cell, plane, 0.0), cell.radius - height);
}

double mirror_wall_compression(double radius, double height) {
  return std::max(0.0, 1.0 - height / radius);
}

}  // namespace acinus::contact
