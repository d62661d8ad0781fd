#pragma once
/// Suction by a pipette: reduced outside pressure on the part of a cell inside the pipette.

#include <array>

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct SuctionLoad {
  Vec3 mouth = Vec3::Zero();  ///< um, centre of the pipette's mouth
  Vec3 axis = Vec3::UnitZ();  ///< unit, from the mouth into the pipette
  double reach = 0;           ///< um, radius of the inside; it lies within the wall of the
                              ///< pipette, which no cell surface enters
  double pressure = 0;        ///< kPa, pressure difference to the outside
};

/// Adds pressure times area, along the outward normal, on the surface behind the mouth. Triangles
/// cut by the plane of the mouth count with their part behind it, so the force is continuous. The
/// net force is balanced by the contact with the pipette.
void add_suction_load(const dcm::GroupView& g, const SuctionLoad& load, solve::System& system);

/// Integrals of the three linear shape functions of a triangle over its part where the linear
/// function with these values at the corners is positive, over the area of the triangle.
std::array<double, 3> positive_part(const std::array<double, 3>& height);

}  // namespace acinus::coupling
