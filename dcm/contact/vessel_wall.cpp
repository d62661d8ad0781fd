#include "dcm/contact/vessel_wall.hpp"

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::dcm {

double wall_stiffness(double repulsion, const contact::Material& wall, double radius,
                      double indentation) {
  if (!std::isfinite(wall.young)) return repulsion;
  const double d = std::clamp(indentation / radius, kLeastIndentation, contact::kMostIndentation);
  const double modulus = wall.young / (1 - wall.poisson * wall.poisson);
  const double winkler = 4 * modulus / (3 * kPi * radius * std::sqrt(d));
  return 1 / (1 / repulsion + 1 / winkler);
}

}  // namespace acinus::dcm
