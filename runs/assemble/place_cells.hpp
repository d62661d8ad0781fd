#pragma once
/// Where the cells of a scene start, and which model each of them is.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "coupling/generate/lobule.hpp"
#include "coupling/world/world.hpp"
#include "geometry/surface.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

struct PlacedCell {
  std::int64_t lineage = 0;  ///< number in the order of generation: the same whatever the model
  Vec3 center = Vec3::Zero();
  std::string type;
  double radius = 0;  ///< um at rest
  bool deformable = false;
  bool oriented = true;  ///< keep the mesh as it is; generated cells get a random orientation
  bool shaped = false;   ///< has the shape of a surface, see cells.file
  Vec3 pull = Vec3::Zero();
};

/// The closed surfaces of cells.file, in um; none unless the scene has one.
/// @throws Error for a file that cannot be used, with the body
std::vector<geometry::Surface> read_cell_surfaces(const Scene& scene);

/// All cells of the scene. Depends on the seed and the geometry, not on the models.
/// @param lobule   empty unless the scene has one
/// @param surface  of read_cell_surfaces: cell k has the volume and the middle of surface k
/// @throws Error when a source cannot place what is asked
std::vector<PlacedCell> place_cells(const Scene& scene, const coupling::Lobule* lobule,
                                    std::span<const geometry::Surface> surface,
                                    const contact::Boundary& boundary);

/// Every cell that starts inside a vessel or another obstacle, outside a wall or in another cell,
/// in one message; before that, the first of an absurd size or place.
/// @throws Error if there is any
void check_starts(const Scene& scene, const std::vector<PlacedCell>& cells,
                  const contact::Boundary& boundary);

/// How many cells a scene asks for at its start; there may be room for fewer.
double count_wanted_cells(const Scene& scene);

}  // namespace acinus::runs
