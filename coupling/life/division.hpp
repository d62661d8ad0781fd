#pragma once
/// Division of a cell into two daughters.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Quality figures of the division of a deformable cell.
struct DivisionFigures {
  std::int64_t mother = -1;
  int planes = 0;                      ///< planes tried
  int steps = 0;                       ///< steps of the sub-simulations
  double volume_error = 0;             ///< larger |V_daughter - V_mother / 2| / V_mother
  double outside = 0;                  ///< um, farthest node of a daughter outside the mother
  double pressure = 0;                 ///< kPa, cytosol of the mother
  double pressure_change = 0;          ///< kPa, larger change from mother to daughter at the cut
  double settled_pressure_change = 0;  ///< kPa, larger change after settling
  double settled_shift = 0;            ///< um, largest node displacement of a daughter in settling
  double min_quality = 1;
};

/// Meshes of two daughters.
struct DaughterMeshes {
  std::array<std::vector<Vec3>, 2> node;  ///< um
  double stretch = 1;                     ///< area of the surface of the mother over its reference
  Vec3 axis = Vec3::UnitX();
  DivisionFigures figures;
};

/// Divides a deformable cell: a plane halves its volume, and a new mesh is projected onto each
/// half. A half that is too folded is filled in a sub-simulation (fill.hpp). Other planes are tried
/// if the cut is not one loop or a mesh is not sound. [VanLiedekerke2020, section 2.1.2 and Fig. 3;
/// decision 14]
/// @return false if no plane was accepted; `why` is the cause at the last one
[[nodiscard]] bool split_shell(const World& world, std::size_t lane, DaughterMeshes& daughters,
                               std::string& why);

/// Division axis, unit, from one daughter to the other: random, given, or along the nearest vessel.
/// Later attempts are tilted at random.
Vec3 division_axis(const World& world, const CycleParams& cycle, std::int64_t lineage,
                   const Vec3& center, int attempt);

}  // namespace acinus::coupling
