#include "runs/assemble/cell_constants.hpp"

namespace acinus::runs {
namespace {

struct TermConstant {
  const char* name;  ///< key in law files
  double DcmBlock::*value;
  bool softens;
};

/// Constants of all terms of a deformable cell; a new term enters its own here.
constexpr TermConstant kTermConstants[] = {
    {"cortex_young_kPa", &DcmBlock::cortex_young, true},
    {"cortex_thickness_um", &DcmBlock::cortex_thickness, false},
    {"cortex_poisson", &DcmBlock::cortex_poisson, false},
    {"area_modulus_nN_per_um", &DcmBlock::area_modulus, false},
    {"local_area_modulus_nN_per_um", &DcmBlock::local_area_modulus, false},
    {"cortex_tension_nN_per_um", &DcmBlock::cortex_tension, true},
    {"bulk_modulus_kPa", &DcmBlock::bulk_modulus, true}};

}  // namespace

CellType softened(const CellType& type) {
  CellType soft = type;
  for (const TermConstant& c : kTermConstants)
    if (c.softens) soft.dcm.*c.value *= type.softening;
  soft.adhesion *= type.softening;
  return soft;
}

calibration::Parameters term_constants(const DcmBlock& cell) {
  calibration::Parameters constants;
  for (const TermConstant& c : kTermConstants) constants[c.name] = cell.*c.value;
  return constants;
}

}  // namespace acinus::runs
