#pragma once
/// Reader of legacy VTK files (versions 1 to 5, ASCII and big-endian binary): the parts that
/// networks and surfaces need.

#include <string>
#include <vector>

#include "geometry/readers/vtk_dataset.hpp"

namespace acinus::geometry {

/// Reads a file whose DATASET is one of `allowed`; `remedy` ends the error when it is not. Throws
/// Error (Exit::kBadInput) with the line, or the byte in a binary file, for a file that is not
/// legacy VTK, is truncated, or holds a coordinate that is not finite.
VtkLegacy read_vtk_legacy(const std::string& path, const std::vector<std::string>& allowed,
                          const std::string& remedy);

}  // namespace acinus::geometry
