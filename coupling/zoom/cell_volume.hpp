#pragma once
/// Available volume of a sphere in its tissue.

#include <cstddef>

#include "coupling/world/world.hpp"
#include "dcm/shape/available_volume.hpp"

namespace acinus::coupling {

/// Largest length of a ray from the centre, over the radius of the sphere.
inline constexpr double kRayReach = 1.6;

/// Builds the available volume of a sphere, star-shaped about its centre: bounded by the power
/// planes of neighbouring spheres, the surfaces of deformable neighbours, walls, vessels and static
/// meshes.
/// @param radius  [cbm cells] um
dcm::AvailableVolume make_available_volume(const World& world, std::size_t sphere,
                                           std::span<const double> radius);

}  // namespace acinus::coupling
