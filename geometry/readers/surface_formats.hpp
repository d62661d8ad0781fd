#pragma once
/// Parts of read_surface.cpp, one per file format. Not for use elsewhere.

#include <string>
#include <vector>

#include "geometry/bodies.hpp"
#include "geometry/readers/input_file.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Appends one polygon, cut into triangles, to out.triangle. @param corner  indices into out.node,
/// already in range. @return the fault of the polygon: fewer than 3 or more than kMaxPolygon
/// corners, or a node twice; empty: none. The caller adds the place, since finding it may cost a
/// search.
[[nodiscard]] std::string add_polygon(const std::vector<int>& corner, Surface& out);

/// Reads all faces of a file, in file units. Throws Error as read_surfaces does.
Soup read_obj(const std::string& path);
Soup read_ply(const std::string& path);
Soup read_stl(const std::string& path);

}  // namespace acinus::geometry
