#pragma once
/// Mechanical constants of one type of deformable cell. Constant after load.

#include <cmath>
#include <optional>

#include "core/vec.hpp"
#include "dcm/contractile_ring.hpp"
#include "dcm/nucleus.hpp"

namespace acinus::dcm {

struct Params {
  double spring_stiffness = 0;          ///< nN/um, k_s
  double bending_stiffness = 0;         ///< nN um, k_b
  double fold_repulsion = 0;            ///< nN/um^3, of two faces folded onto each other
  double area_modulus = 0;              ///< nN/um, K_A of the whole surface
  double local_area_modulus = 0;        ///< nN/um, K_A of each triangle
  double cortex_tension = 0;            ///< nN/um, active tension T of the surface
  std::optional<ContractileRing> ring;  ///< of that tension; empty: uniform
  double bulk_modulus = 0;              ///< kPa, K_V
  double nodal_friction = 0;            ///< nN s/um, gamma_int per edge
  double friction_across = 1;   ///< nodal friction across an edge over that along it: 1 isotropic,
                                ///< 0 along the edge only (objective)
  double series_friction = 0;   ///< nN s/um, dashpot in series with each spring; 0: none, the
                                ///< springs remember their length at rest
  double medium_friction = 0;   ///< nN s/um^3, per surface area; used unless viscosity > 0
  double viscosity = 0;         ///< nN s/um^2, Stokes drag 6 pi eta R spread over the surface
  double diffusion = 0;         ///< um^2/s, random motility D
  double adhesion = 0;          ///< nN/um, W of this type with itself
  double vessel_friction = 0;   ///< nN s/um^3
  double cortex_thickness = 0;  ///< um; rims of daughters are rounded to it
  std::optional<Nucleus> nucleus;  ///< empty: none
};

/// Cortex spring constant of a triangular spring net, k_s = (sqrt 3 / 2) E h.
/// [VanLiedekerke2020, Eq. (7), inverted there: a net with constant k has the 2D modulus (2/sqrt 3)
/// k]
inline double cortex_spring_stiffness(double young_kpa, double thickness_um) {
  return std::sqrt(3.0) / 2 * young_kpa * thickness_um;
}

/// Cortex bending constant, k_b = E h^3 / (12 (1 - nu^2)).   [VanLiedekerke2020, Eq. (10)]
inline double cortex_bending_stiffness(double young_kpa, double thickness_um, double poisson) {
  return young_kpa * thickness_um * thickness_um * thickness_um / (12 * (1 - poisson * poisson));
}

/// Drag of a sphere in a liquid, 6 pi eta R, nN s/um.
inline double stokes_drag(double viscosity, double radius_um) {
  return 6 * kPi * viscosity * radius_um;
}

/// Pressure in the cytosol, p = -K_V ln(V / V0), kPa.   [VanLiedekerke2020, Eq. (11)]
inline double cytosol_pressure(double bulk_modulus, double volume, double reference_volume) {
  return -bulk_modulus * std::log(volume / reference_volume);
}

}  // namespace acinus::dcm
