#pragma once
/// Contact figures of spheres at the positions of deformable cells, by existing and candidate
/// stiffness laws.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibration/law.hpp"
#include "cbm/stiffness_law.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// Contact figures of a cell, of a frame or by a law.
struct JudgedCell {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
  double pressure = 0;         ///< contact pressure, kPa
  double normal_force = 0;     ///< nN
  double contact_area = 0;     ///< um^2
};
using JudgedCells = std::map<std::int64_t, JudgedCell>;  ///< keyed by lineage

/// Overlap measure that determines the modulus of a sphere.
enum class OverlapMeasure {
  kProgram,  ///< as in a run: sum over twelve, single deep overlaps, faces at walls
  kSum,      ///< sum over twelve alone
};

/// Candidate law: modulus of a sphere over its overlaps.
struct SphereLaw {
  std::string name;
  double young = 0;  ///< modulus without contact, kPa
  cbm::StiffnessLaw correction;
  OverlapMeasure measure = OverlapMeasure::kProgram;
};

/// Candidate laws of spheres.
/// @param plain  modulus of uncorrected spheres, kPa
std::vector<SphereLaw> sphere_laws(const calibration::Law& law, double plain);

/// Contact figures of spheres in place of the cells.
/// @param time   s since t = 0, for moving walls
/// @param world  constants and boundary of the scene; its cells are replaced
JudgedCells compute_in_place(const JudgedCells& cells, double time, const SphereLaw& law,
                             coupling::World world);

}  // namespace acinus::bench
