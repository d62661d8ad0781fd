#pragma once
/// What of a lobule stays as it is through a run: its sizes, its vessels, the room they leave.

#include <cstdint>
#include <vector>

#include "contact/boundary.hpp"
#include "core/vec.hpp"
#include "runs/experiments/lesion.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

struct LobuleRoom {
  LesionFrame frame;
  Vec3 axis = Vec3::Zero();                  ///< um, foot of the central vein
  double from_angle = -kPi, to_angle = kPi;  ///< rad, what of the full turn there is
  double free_volume = 0;                    ///< um^3 between the planes outside vessels
  std::vector<std::uint8_t> sinusoid;        ///< [segment] 1: thinner than the central vein
};

/// The volume of the vessels is counted on a grid of 2 um; its error is about 1 % of it.
/// @pre the scene has a lobule
LobuleRoom make_lobule_room(const Scene& scene, const contact::Vessels& vessels);

}  // namespace acinus::runs
