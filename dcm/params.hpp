#pragma once
/// Mechanical constants of one type of deformable cell. Constant after load.

#include <cmath>
#include <optional>
#include <vector>

#include "core/vec.hpp"
#include "dcm/contractile_ring.hpp"
#include "dcm/nucleus.hpp"

namespace acinus::dcm {

/// Constants of the cortex of Table 1, from which the default springs and hinges follow.
inline constexpr double kCortexYoung = 1;        // kPa
inline constexpr double kCortexThickness = 0.5;  // um
inline constexpr double kCortexPoisson = 0.5;

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

/// Constants of one type of deformable cell, by default those of a scene.
struct Params {
  double spring_stiffness =
      cortex_spring_stiffness(kCortexYoung, kCortexThickness);  ///< nN/um, k_s
  double bending_stiffness = cortex_bending_stiffness(kCortexYoung, kCortexThickness,
                                                      kCortexPoisson);  ///< nN um, k_b
  double fold_repulsion = 5;            ///< nN/um^3, of two faces folded onto each other
  double area_modulus = 0.8;            ///< nN/um, K_A of the whole surface
  double local_area_modulus = 0;        ///< nN/um, K_A of each triangle
  double cortex_tension = 0;            ///< nN/um, active tension T of the surface
  std::optional<ContractileRing> ring;  ///< of that tension; empty: uniform
  double bulk_modulus = 2.5;            ///< kPa, K_V
  double nodal_friction = 0.1;          ///< nN s/um, gamma_int per edge
  double friction_across = 1;    ///< nodal friction across an edge over that along it: 1 isotropic,
                                 ///< 0 along the edge only (objective)
  double series_friction = 0;    ///< nN s/um, dashpot in series with each spring; 0: none, the
                                 ///< springs remember their length at rest
  double medium_friction = 0.1;  ///< nN s/um^3, per surface area; used unless viscosity > 0
  double viscosity = 0;          ///< nN s/um^2, Stokes drag 6 pi eta R spread over the surface
  double diffusion = 1e-4;       ///< um^2/s, random motility D
  double adhesion = 0.01;        ///< nN/um, W of this type with itself
  /// [type] nN/um, W with each type; empty: the geometric mean of both.
  std::vector<double> adhesion_with;
  double vessel_friction = 0.1;                ///< nN s/um^3
  double cortex_thickness = kCortexThickness;  ///< um; rims of daughters are rounded to it
  std::optional<Nucleus> nucleus;              ///< empty: none
};

/// Constants of a cell on which no term acts: no stiffness, friction, motility or adhesion.
inline Params params_without_terms() {
  Params p;
  p.spring_stiffness = p.bending_stiffness = p.fold_repulsion = 0;
  p.area_modulus = p.bulk_modulus = 0;
  p.nodal_friction = p.medium_friction = p.vessel_friction = 0;
  p.diffusion = p.adhesion = p.cortex_thickness = 0;
  return p;
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
