#pragma once
/// The studies that come with the program.

#include <string>
#include <vector>

#include "runs/scene/shipped_scenes.hpp"

namespace acinus::runs {

/// All shipped studies by name, in runs/studies beside runs/scenes; none if there is no such
/// folder.
std::vector<ShippedScene> shipped_studies();

/// A study file, or that of a shipped study of this name.
/// @throws Error with a hint if there is neither
std::string find_study(const std::string& name);

}  // namespace acinus::runs
