#pragma once
/// Writers of triangle surfaces for other programs.

#include <cstdint>
#include <span>
#include <string>

#include "geometry/surface.hpp"

namespace acinus::io {

/// Throws Error(kBadInput) unless the ending of a path is that of a supported format: .vtk, .vtp,
/// .stl, .obj.
void check_surface_file(const std::string& path);

/// Writes a surface as VTK PolyData (legacy or XML, doubles), binary STL (floats, corners of each
/// triangle) or Wavefront OBJ, by the ending; lengths in um. The file appears whole or not at all.
/// Throws as check_surface_file, and Error(kFileError) when the disk refuses.
void write_surface(const std::string& path, const geometry::Surface& surface);

/// Writes several surfaces into one legacy VTK file, with a number each (the array "label" of its
/// triangles). read_surfaces returns them in this order. Throws as write_surface.
/// @param label  one a surface
void write_surfaces(const std::string& path, std::span<const geometry::Surface> surfaces,
                    std::span<const std::uint32_t> label);

}  // namespace acinus::io
