#pragma once
/// Studies that ship with the program.

#include <string>
#include <vector>

#include "runs/scene/shipped_scenes.hpp"

namespace acinus::runs {

/// Shipped studies by name, from runs/studies beside runs/scenes; empty without that folder.
std::vector<ShippedScene> shipped_studies();

/// Path of a study file, or of the shipped study of that name.
/// @throws Error with the nearest name if there is neither
std::string find_study(const std::string& name);

}  // namespace acinus::runs
