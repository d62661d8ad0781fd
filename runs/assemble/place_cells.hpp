#pragma once
/// Starting positions, sizes and models of the cells of a scene.

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

/// Cell at its starting position.
struct PlacedCell {
  std::int64_t lineage = 0;  ///< index in the order of generation, independent of the models
  Vec3 center = Vec3::Zero();
  std::string type;
  double radius = 0;  ///< rest radius, um
  bool deformable = false;
  bool oriented = true;  ///< mesh keeps its orientation; generated cells get a random one
  bool shaped = false;   ///< takes the shape of a surface of cells.file
  Vec3 pull = Vec3::Zero();
};

/// Closed surfaces of cells.file, um; empty for any other source of cells.
/// @throws Error for an unusable file, naming the body
std::vector<geometry::Surface> read_cell_surfaces(const Scene& scene);

/// Places all cells of the scene. Positions depend on seed and geometry, not on the models.
/// @param lobule   generated lobule of the scene, null if it has none
/// @param surface  [n_cell] from read_cell_surfaces(): cell k gets the volume and centroid of
///                 surface k
/// @throws Error if a source cannot place the cells asked for
std::vector<PlacedCell> place_cells(const Scene& scene, const coupling::Lobule* lobule,
                                    std::span<const geometry::Surface> surface,
                                    const contact::Boundary& boundary);

/// Refuses cells of absurd size or position, and cells that start inside an obstacle, outside a
/// wall or in another cell. One message lists them.
/// @throws Error
void check_starts(const Scene& scene, const std::vector<PlacedCell>& cells,
                  const contact::Boundary& boundary);

/// Number of cells that a scene asks for at its start; an upper bound, since not all may fit.
double count_wanted_cells(const Scene& scene);

}  // namespace acinus::runs
