#pragma once
/// Constants of one type of centre-based cell. Constant after load.

namespace acinus::cbm {

struct Params {
  double poisson = 0.47;
  double medium_friction = 0;  ///< nN s/um^3, gamma_ECM; used unless viscosity > 0
  double viscosity = 0;        ///< nN s/um^2, Stokes drag 6 pi eta R
  double diffusion = 0;        ///< um^2/s
  double adhesion = 0;         ///< nN/um
  double vessel_friction = 0;  ///< nN s/um^3
};

/// Young's modulus that matches a deformable cell's bulk modulus, E = 3 K_V (1 - 2 nu), kPa.
/// [VanLiedekerke2020, section 2.3, whose printed form is inverted: this one gives Table 1's 450
/// Pa]
inline double young_from_bulk(double bulk_modulus, double poisson) {
  return 3 * bulk_modulus * (1 - 2 * poisson);
}

}  // namespace acinus::cbm
