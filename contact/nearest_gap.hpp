#pragma once
/// The distance of a point to everything rigid around it.

#include <string>

#include "contact/boundary.hpp"

namespace acinus::contact {

/// Gap to the nearest of all walls, vessels and static meshes, um: negative where cells may not be,
/// infinite without boundary. Cost: all of them, for a single point.
/// @param time  s since t = 0, for which moving walls stand
/// @param name  gets how messages name the nearest one
double nearest_gap(const Boundary& boundary, const Vec3& x, double time,
                   std::string* name = nullptr);

}  // namespace acinus::contact
