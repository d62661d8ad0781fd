#pragma once
/// From a scene to a world: vessels, walls, cells and constants.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "geometry/network.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// A world ready for its first step, and what is worth telling about how it was made.
struct BuiltWorld {
  coupling::World world;
  std::vector<std::string> type_names;  ///< of the type index
  Notes notes;
  double vessel_length = 0;  ///< um
};

/// Generates or reads the geometry, places the cells and checks that they fit.
/// @throws Error for files that cannot be used and cells that start in the wrong place
BuiltWorld build_world(const Scene& scene, const Ranks& ranks);

}  // namespace acinus::runs
