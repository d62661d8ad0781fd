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

/// Parameters of the lobule generator from the scene.
/// @pre the scene has a lobule
coupling::LobuleParameters lobule_parameters(const Scene& scene);

/// Lobule of the scene, generated with its seed.
/// @pre the scene has a lobule
coupling::Lobule draw_lobule(const Scene& scene);

/// Vessel network of the scene at rest; no segments if the scene has no vessels.
/// @param lobule  generated lobule of the scene, null if it has none
/// @throws Error for an unusable network file
geometry::Network build_network(const Scene& scene, const coupling::Lobule* lobule);
geometry::Network build_network(const Scene& scene);

/// Adds vessels, walls, capsule, pipette and static meshes of the scene to the boundary.
/// @param lobule  generated lobule of the scene, null if it has none
/// @param notes   receives warnings about the vessel surface
/// @throws Error for unusable files
void add_boundary(const Scene& scene, const coupling::Lobule* lobule, contact::Boundary& boundary,
                  Notes& notes);

/// Beam tree of flexible vessels; empty if the vessels are rigid or absent.
/// @param rest  vessel network of the boundary at rest
/// @throws Error if vessels.anchors is "ends" and the network has no end
coupling::VesselTree build_tree(const Scene& scene, const geometry::Network& rest);

/// Names of all obstacles of the scene (lobule planes, walls, capsule, pipette, static meshes),
/// without building them.
std::vector<std::string> boundary_names(const Scene& scene);

}  // namespace acinus::runs
