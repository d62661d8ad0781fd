#pragma once
/// The parts of read_surface.cpp, one per file format. Not for use elsewhere.

#include <string>
#include <vector>

#include "core/mesh/input_file.hpp"
#include "core/mesh/surface.hpp"

namespace acinus::mesh {

/// Appends one polygon, cut into triangles, to out.triangle. @param corner  indices into out.node,
/// already in range. Throws Error at `place` naming it `what` when it has fewer than 3 or more than
/// kMaxPolygon corners, or uses a node twice.
void add_polygon(const InputFile& file, std::size_t place, const std::string& what,
                 const std::vector<int>& corner, Surface& out);

/// All faces of a file as one surface, in file units. Throw Error as read_surfaces does.
Surface read_obj(const std::string& path);
Surface read_ply(const std::string& path);
Surface read_stl(const std::string& path);

}  // namespace acinus::mesh
