#pragma once
/// Result of a calibration: the stiffness of spheres, by overlap, that carries the forces of
/// deformable cells.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "cbm/stiffness_law.hpp"

namespace acinus::calibration {

/// Constants of a cell type by name with unit, e.g. "bulk_modulus_kPa".
using Parameters = std::map<std::string, double>;

struct TableEntry {
  double overlap = 0, modulus = 0;  ///< d, kPa
};

/// Stiffness law E~(d) = a0 + a1 d^power [VanLiedekerke2020, Eq. (22)], or a table.
struct Law {
  double a0 = 0;                          ///< kPa, of a cell without contacts
  double a1 = 0;                          ///< kPa
  double power = 4;                       ///< of the term with a1
  std::vector<TableEntry> table;          ///< in place of that term; ascending, the first one is a0
  std::array<double, 2> a1_interval{};    ///< kPa, 95 % confidence
  std::array<double, 2> overlap_range{};  ///< range of d in the fit
  double wall_recess = 0;                 ///< cbm::StiffnessLaw::wall_recess
  /// Friction per area of contact between spheres, over that between deformable cells, with which
  /// layers of both slide alike (sliding.hpp). 0: not measured.
  double friction_share = 0;
  /// Force at which two deformable cells part, over that of two spheres; no part of the law, which
  /// knows compression only. 0: not measured.
  double pull_off_ratio = 0;
  double r_squared = 0;
  double rms_relative = 0;  ///< of the force, over the range
  double jkr_underestimation =
      0;                ///< force of deformable cells over that of plain spheres, end of range
  Parameters dcm, cbm;  ///< parameters of the cells that the law holds for
  std::vector<std::string> warnings;  ///< objections to its use (reliability.hpp)
  std::map<std::string, std::string> provenance;
};

/// Largest friction share of a law.
inline constexpr double kLargestFrictionShare = 10;

/// Stiffness law for the contact of spheres.
cbm::StiffnessLaw stiffness_law(const Law& law);

/// Differences between the law's parameters and others, one line per constant that differs by more
/// than 1e-6 of itself, or that only one side has: "dcm.bulk_modulus_kPa: the law holds for 2.5,
/// here it is 5". Empty: the law holds for these cells.
std::vector<std::string> list_differences(const Law& law, const Parameters& dcm,
                                          const Parameters& cbm);

}  // namespace acinus::calibration
