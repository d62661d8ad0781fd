#pragma once
/// Triangulated pipette for files and pictures. Contacts use its exact shape.

#include "contact/boundary.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

/// Adds the wall of a pipette: a closed ring with rounded rims, 48 sides, four steps per quarter
/// circle. Its corners lie on the wall.
void add_pipette_surface(const contact::Pipette& pipette, geometry::Surface& surface);

}  // namespace acinus::coupling
