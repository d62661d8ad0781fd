#pragma once
/// Readers of cell and wall meshes.

#include <string>
#include <vector>

#include "geometry/closed.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Reads legacy VTK (ASCII or binary; POLYDATA polygons, or UNSTRUCTURED_GRID of polyhedra,
/// triangles, quads, polygons), OBJ, PLY and STL (the latter ASCII or binary; equal corners of STL
/// are merged, collapsed facets dropped). One Surface per polyhedron in file order, then one per
/// connected component of the other faces, ordered by their first face. Polygons are cut into
/// triangles; nodes a body does not use are left out and the others keep their order. Orientation
/// is the file's; walls may be open.
/// @param um_per_unit  um per file unit, 1e6 for metres
/// Throws Error (Exit::kBadInput) with file, line or byte, the value found and advice.
std::vector<Surface> read_surfaces(const std::string& path, double um_per_unit);

/// Reads closed surfaces: read_surfaces, then check_closed on each as "path: body N" (from 0).
/// Every body is a closed outward surface, or Error.
std::vector<Surface> read_closed_surfaces(const std::string& path, double um_per_unit);

}  // namespace acinus::geometry
