#pragma once
/// Voxel sides on the command line.

#include <string>

#include "core/vec.hpp"

namespace acinus::cli {

/// Sides of a voxel from the text of --voxel, um: "0.5 um" for all three, or "0.5 um, 0.5 um, 1 um"
/// along x, y and z.   @throws Error naming the flag
Vec3 parse_voxel(const std::string& text);

}  // namespace acinus::cli
