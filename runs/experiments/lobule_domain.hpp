#pragma once
/// Constant geometry of a lobule: sizes, sinusoids, volume outside vessels.

#include <cstdint>
#include <vector>

#include "contact/boundary.hpp"
#include "core/vec.hpp"
#include "runs/experiments/lesion.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Sizes and vessels of a lobule that do not change through a run.
struct LobuleDomain {
  LesionFrame frame;
  Vec3 axis = Vec3::Zero();                  ///< um, foot of the central vein
  double from_angle = -kPi, to_angle = kPi;  ///< rad, sector of the full turn
  double free_volume = 0;                    ///< um^3 between the planes outside vessels
  std::vector<std::uint8_t> sinusoid;        ///< [segment] 1: thinner than the central vein
};

/// Domain of the scene's lobule. The volume of the vessels is counted on a grid of 2 um with an
/// error of about 1 %.
/// @pre the scene has a lobule
LobuleDomain make_lobule_domain(const Scene& scene, const contact::Vessels& vessels);

}  // namespace acinus::runs
