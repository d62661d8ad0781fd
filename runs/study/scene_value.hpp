#pragma once
/// Numbers of a resolved scene by key, for plots over a key.

#include <optional>
#include <string>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Unit of a key in a resolved scene, "1" if dimensionless; empty if the key does not exist or has
/// no single number. A key whose unit another one decides, as rules.<number>.half_max, counts as a
/// plain number: that of a concentration.
/// @param key  as in --set: "motility.leader_force"
std::optional<std::string> unit_of_key(const std::string& key);

/// Value of such a key in that unit; empty if the scene lacks it or has "auto".
std::optional<double> value_of_key(const Scene& scene, const std::string& key);

}  // namespace acinus::runs
