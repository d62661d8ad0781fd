#pragma once
/// What a calibration found: how stiff spheres must become to carry what deformable cells carry.

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

/// E~(d) = a0 + a1 d^power   [VanLiedekerke2020, Eq. (22)], or a table
struct Law {
  double a0 = 0;                          ///< kPa, of a cell that nothing touches
  double a1 = 0;                          ///< kPa
  double power = 4;                       ///< of the term with a1
  std::vector<TableEntry> table;          ///< in place of that term; ascending, the first one is a0
  std::array<double, 2> a1_interval{};    ///< kPa, 95 % confidence
  std::array<double, 2> overlap_range{};  ///< of d in the fit
  double wall_recess = 0;                 ///< cbm::StiffnessLaw::wall_recess
  double r_squared = 0;
  double rms_relative = 0;  ///< of the force, over the range
  double jkr_underestimation =
      0;                ///< force of deformable cells over that of plain spheres, end of range
  Parameters dcm, cbm;  ///< what it was found for
  std::vector<std::string> warnings;  ///< what speaks against using it (reliability.hpp)
  std::map<std::string, std::string> provenance;
};

/// The law as the contact of spheres uses it.
cbm::StiffnessLaw stiffness_law(const Law& law);

/// One line per constant that differs by more than 1e-6 of itself, or that only one side has:
/// "dcm.bulk_modulus_kPa: the law holds for 2.5, here it is 5". Empty: the law is for these cells.
std::vector<std::string> list_differences(const Law& law, const Parameters& dcm,
                                          const Parameters& cbm);

}  // namespace acinus::calibration
