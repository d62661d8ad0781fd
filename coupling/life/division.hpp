#pragma once
/// Division of a cell: two daughters in the place of their mother.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// How well one division of a deformable cell went.
struct DivisionFigures {
  std::int64_t mother = -1;
  int planes = 0;                      ///< tried
  int steps = 0;                       ///< of the sub-simulations
  double volume_error = 0;             ///< larger |V_daughter - V_mother / 2| / V_mother
  double outside = 0;                  ///< um, farthest node of a daughter outside the mother
  double pressure = 0;                 ///< kPa, of the mother's cytosol
  double pressure_change = 0;          ///< kPa, larger change from mother to daughter as cut
  double settled_pressure_change = 0;  ///< kPa, the same when the daughters have settled
  double settled_shift = 0;            ///< um, farthest a node of a daughter moved meanwhile
  double min_quality = 1;
};

/// The meshes of two daughters.
struct DaughterMeshes {
  std::array<std::vector<Vec3>, 2> node;  ///< um
  double stretch = 1;                     ///< of the mother's surface, area over its reference
  Vec3 axis = Vec3::UnitX();
  DivisionFigures figures;
};

/// Splits a deformable cell: a plane through it halves its volume, and a fresh mesh follows the
/// surface of each half; a half that is too folded for that is filled in a sub-simulation
/// (fill.hpp). Other planes are tried if the cut is not one loop or a daughter's mesh is not sound.
/// [VanLiedekerke2020, section 2.1.2 and Fig. 3; docs/decisions/0014.md]
/// @return false if no plane served; `why` says what was wrong with the last one
[[nodiscard]] bool split_shell(const World& world, std::size_t lane, DaughterMeshes& daughters,
                               std::string& why);

/// Direction from one daughter to the other, unit: random, given, or along the nearest vessel.
/// Later attempts turn away from it at random.
Vec3 division_axis(const World& world, const CycleParams& cycle, std::int64_t lineage,
                   const Vec3& center, int attempt);

}  // namespace acinus::coupling
