#pragma once
/// Suction in a pipette: lower pressure outside that part of a cell which is inside the pipette.

#include <array>

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct SuctionLoad {
  Vec3 mouth = Vec3::Zero();  ///< um, centre of the pipette's mouth
  Vec3 axis = Vec3::UnitZ();  ///< unit, from the mouth into the pipette
  double reach = 0;           ///< um from the axis, what is farther out is not inside; within the
                              ///< pipette's wall, where no surface is
  double pressure = 0;        ///< kPa below that outside
};

/// Adds pressure times area, along the outward normal, on the part of the surface behind the mouth.
/// A triangle that the plane of the mouth cuts counts with the part behind it, so that the force
/// has no jumps. It has a net force: whatever holds the cell, the pipette, balances it.
void add_suction_load(const dcm::GroupView& g, const SuctionLoad& load, solve::System& system);

/// Integrals of the three linear shape functions of a triangle over its part where the linear
/// function with these values at the corners is positive, over the area of the triangle.
std::array<double, 3> positive_part(const std::array<double, 3>& height);

}  // namespace acinus::coupling
