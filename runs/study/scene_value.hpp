#pragma once
/// One number of a resolved scene, for plots over a key.

#include <optional>
#include <string>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Unit in which a resolved scene shows a key ("1" without); nothing if it is no key with one
/// number as value. @param key  as in --set: "motility.leader_force"
std::optional<std::string> unit_of_key(const std::string& key);

/// The value of such a key in that unit; nothing if this scene has none or "auto".
std::optional<double> value_of_key(const Scene& scene, const std::string& key);

}  // namespace acinus::runs
