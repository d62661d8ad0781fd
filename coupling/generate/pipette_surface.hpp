#pragma once
/// A pipette as triangles, for files and pictures. Contacts use its exact shape.

#include "contact/boundary.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

/// Adds its wall: a closed ring with rounded rims, 48 sides, four steps a quarter of a circle. Its
/// corners lie on the wall.
void add_pipette_surface(const contact::Pipette& pipette, geometry::Surface& surface);

}  // namespace acinus::coupling
