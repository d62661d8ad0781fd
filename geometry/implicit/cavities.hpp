#pragma once
/// Cavities of a surface, which nothing outside can touch.

#include "geometry/implicit/zero_surface.hpp"

namespace acinus::geometry {

/// Leaves out the walls of cavities: closed parts that face inward. Where vessels bend or meet,
/// round cones leave pockets between them that no network knows of.
void leave_out_cavities(ZeroSurface& z);

}  // namespace acinus::geometry
