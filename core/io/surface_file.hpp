#pragma once
/// Writes triangle surfaces for other programs.

#include <string>

#include "core/mesh/surface.hpp"

namespace acinus::io {

/// Throws Error(kBadInput) unless the ending of a path names a format that is written: .vtp, .stl,
/// .obj.
void check_surface_file(const std::string& path);

/// VTK XML PolyData (doubles), binary STL (floats, corners of each triangle) or Wavefront OBJ, by
/// the ending; lengths in um. The file appears whole or not at all.
/// Throws as check_surface_file, and Error(kFileError) when the disk refuses.
void write_surface(const std::string& path, const mesh::Surface& surface);

}  // namespace acinus::io
