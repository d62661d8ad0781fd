#pragma once
/// World of a scene: vessels, walls, cells and constants.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "geometry/network.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// World ready for its first step, with notes about its construction.
struct BuiltWorld {
  coupling::World world;
  std::vector<std::string> type_names;  ///< [type index]
  Notes notes;
  double vessel_length = 0;  ///< total length of the network, um
};

/// Generates or reads the geometry, places the cells and checks their starting positions.
/// @throws Error for unusable files and for cells that start inside obstacles or each other
BuiltWorld build_world(const Scene& scene, const Ranks& ranks);

}  // namespace acinus::runs
