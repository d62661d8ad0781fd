#pragma once
/// Constants of one type of centre-based cell. Constant after load.

#include <cstdint>
#include <vector>

#include "cbm/stiffness_law.hpp"
#include "core/numbers/random.hpp"

namespace acinus::cbm {

/// Young's modulus that matches a deformable cell's bulk modulus, E = 3 K_V (1 - 2 nu), kPa.
/// [VanLiedekerke2020, section 2.3, whose printed form is inverted: this one gives Table 1's 450
/// Pa]
inline double young_from_bulk(double bulk_modulus, double poisson) {
  return 3 * bulk_modulus * (1 - 2 * poisson);
}

/// Constants of one type of sphere, by default those of a scene.
struct Params {
  double young = young_from_bulk(2.5, 0.47);  ///< kPa, mean over cells
  double young_spread = 0.1;                  ///< relative standard deviation from cell to cell
  double poisson = 0.47;
  double cell_friction = 10;  ///< nN s/um^3, with another sphere; of two types the geometric mean
  double medium_friction = 0.5;  ///< nN s/um^3, gamma_ECM; used unless viscosity > 0
  double viscosity = 0;          ///< nN s/um^2, Stokes drag 6 pi eta R
  bool whole_medium_area =
      false;                ///< true: the medium acts on the whole surface, false: on its free part
  double diffusion = 1e-4;  ///< um^2/s
  double adhesion = 0.01;   ///< nN/um, W of this type with itself
  /// [type] nN/um, W with each type; empty: the geometric mean of both.
  std::vector<double> adhesion_with;
  double vessel_friction = 0.5;  ///< nN s/um^3
  StiffnessLaw correction;
};

/// Young's modulus of one cell: Gaussian about the mean of its type, cut at 3 standard deviations,
/// kPa.   [VanLiedekerke2020, Table 1]
inline double draw_young(const Params& p, std::uint64_t seed, std::int64_t lineage) {
  return truncated_normal({seed, Purpose::kYoungModulus, static_cast<std::uint64_t>(lineage), 0, 0},
                          p.young, p.young_spread * p.young, 3);
}

}  // namespace acinus::cbm
