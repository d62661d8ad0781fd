#pragma once
/// The room that a sphere has in its tissue.

#include <cstddef>

#include "coupling/world/world.hpp"
#include "dcm/shape/room.hpp"

namespace acinus::coupling {

/// How far a room is looked at, over the radius of the sphere.
inline constexpr double kRoomReach = 1.6;

/// The room of a sphere as others leave it, seen from its centre: up to the power planes of
/// neighbouring spheres, the surfaces of deformable neighbours, walls, vessels and static meshes.
/// @param radius  [cbm cells] um
dcm::Room find_room(const World& world, std::size_t sphere, std::span<const double> radius);

}  // namespace acinus::coupling
