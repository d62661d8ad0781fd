#pragma once
/// What spheres bear in the places of deformable cells, by laws that are and laws that might be.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibration/law.hpp"
#include "cbm/stiffness_law.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// A cell of a frame, or what a law makes of it.
struct JudgedCell {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
  double pressure = 0;         ///< kPa, contact pressure
  double normal_force = 0;     ///< nN
  double contact_area = 0;     ///< um^2
};
using JudgedCells = std::map<std::int64_t, JudgedCell>;  ///< by lineage

/// How the modulus of a cell comes from its overlaps.
enum class OverlapMeasure {
  kProgram,     ///< as in a run: sum over twelve, single deep overlaps, faces at walls
  kSum,         ///< sum over twelve and nothing else
  kByContacts,  ///< the sum, more or less of it by the number n of contacts: (n / 7)^0.1
};

struct SphereLaw {
  std::string name;
  double young = 0;  ///< kPa, of a sphere that nothing touches
  cbm::StiffnessLaw correction;
  OverlapMeasure measure = OverlapMeasure::kProgram;
};

/// @param plain  modulus of uncorrected spheres, kPa
std::vector<SphereLaw> sphere_laws(const calibration::Law& law, double plain);

/// @param world  spheres with the constants and the boundary of the scene; its cells do not count
/// @param time   s since t = 0, for which moving walls stand
JudgedCells bear_in_place(const JudgedCells& cells, double time, const SphereLaw& law,
                          coupling::World world);

}  // namespace acinus::bench
