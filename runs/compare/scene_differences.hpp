#pragma once
/// Whether two runs are of the same scene but for the models.

#include <string>
#include <vector>

namespace acinus::runs {

/// Paths of the keys of two canonical scenes that differ and should not: everything but which cells
/// are which model, the constants of spheres, and how the run was made.
std::vector<std::string> scene_differences(const std::string& a, const std::string& b);

}  // namespace acinus::runs
