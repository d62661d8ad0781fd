#pragma once
/// Sides of a voxel as a flag gives them.

#include <string>

#include "core/vec.hpp"

namespace acinus::runs {

/// "0.5 um" for all three sides, or "0.5 um, 0.5 um, 1 um" along x, y and z.
/// @throws Error that names the flag
Vec3 parse_voxel(const char* flag, const std::string& text);

}  // namespace acinus::runs
