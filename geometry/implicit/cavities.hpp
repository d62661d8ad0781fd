#pragma once
/// Cavities of a surface, which nothing outside can reach.

#include "geometry/implicit/zero_surface.hpp"

namespace acinus::geometry {

/// Removes the walls of cavities: closed parts that face inward. Where vessels bend or meet, round
/// cones enclose pockets that are not part of the network.
void remove_cavities(ZeroSurface& z);

}  // namespace acinus::geometry
