#pragma once
/// Gap of a point to the nearest obstacle.

#include <string>

#include "contact/boundary.hpp"

namespace acinus::contact {

/// Gap to the nearest wall, vessel or static mesh at t = 0, um: negative where cells may not be,
/// infinite without obstacles. Cost: linear in the obstacles.
/// @param name  receives the nearest obstacle's name in messages; may be null
double nearest_gap(const Boundary& boundary, const Vec3& x, std::string* name = nullptr);

}  // namespace acinus::contact
