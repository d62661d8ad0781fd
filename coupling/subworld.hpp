#pragma once
/// A small world cut out of a large one: a few cells that move, their neighbours held in place. It
/// is stepped by solve and judge only, while the time of the large world stands still.

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/step.hpp"
#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::coupling {

/// Which cells a small world is made of: lanes of deformable cells, indices of spheres. Ascending.
struct Selected {
  std::vector<std::size_t> dcm, cbm;
};

/// Cells of the other bodies whose boxes come within `reach` of these, um.
Selected find_neighbours(const World& world, const Selected& cells, double reach);

struct Subworld {
  World world;
  Workspace work;
  double time = 0;  ///< s, of the large world
};

/// Copies the cells. Held ones keep their place; reference volumes and references stay what they
/// are at this moment, and nothing moves by itself.
/// @pre `world` outlives the small one (static meshes are shared)
Subworld extract(const World& world, const Selected& moving, const Selected& held);

/// How a small world came to rest.
struct Settling {
  bool ok = true;
  std::string cause;
  int steps = 0;
};

/// Steps the small world for some time, s, with steps that start short: what is stiff and fast has
/// then died down.
Settling relax(Subworld& sub, double duration);

/// Writes places, last movements and contacts of the moving cells back.
void write_back(const Subworld& sub, World& world);

}  // namespace acinus::coupling
