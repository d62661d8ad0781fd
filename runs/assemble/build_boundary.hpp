#pragma once
/// Vessels, walls, capsules and static meshes of a scene.

#include <string>
#include <vector>

#include "contact/boundary.hpp"
#include "coupling/generate/lobule.hpp"
#include "coupling/vessels/vessel_tree.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// @pre the scene has a lobule
coupling::LobuleParameters lobule_parameters(const Scene& scene);

/// The lobule of a scene, drawn with its seed.   @pre the scene has one
coupling::Lobule draw_lobule(const Scene& scene);

/// The vessels of a scene at rest, without the rest of it; none: no segments.
/// @throws Error for a file that cannot be used
geometry::Network build_network(const Scene& scene, const coupling::Lobule* lobule);
geometry::Network build_network(const Scene& scene);

/// @param lobule  null: none
/// @throws Error for files that cannot be used
void add_boundary(const Scene& scene, const coupling::Lobule* lobule, contact::Boundary& boundary,
                  Notes& notes);

/// The tree of flexible vessels; none if they are rigid or there are none.
/// @param rest  the vessels of the boundary
coupling::VesselTree build_tree(const Scene& scene, const geometry::Network& rest);

/// Names of the walls, capsule and closed meshes that a scene's cells meet, without building it.
std::vector<std::string> boundary_names(const Scene& scene);

}  // namespace acinus::runs
