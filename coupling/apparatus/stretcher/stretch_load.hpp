#pragma once
/// Outward stress on the surface of a cell that depends on the angle to an axis, as light puts on a
/// cell between two beams.

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct StretchLoad {
  Vec3 axis = Vec3::UnitX();  ///< a unit vector
  double exponent = 2;        ///< n
  double stress = 0;          ///< kPa where the axis meets the surface
};

/// Adds stress |cos alpha_i|^n dV/dx_i on every node, with alpha_i the angle between the axis and
/// the direction from the centre of the cell (mean of the nodes by rest area) to the node: dV/dx_i
/// is the part of the surface that belongs to the node times its normal. What that leaves as a net
/// force is taken off again, spread by rest areas, so that the cell stays between the beams. The
/// torque is 0 for a cell that is even about the axis; it turns others as the beams would.
/// [VanLiedekerke2020, Eq. (32) with n = 2, and Appendix 3]
void add_stretch_load(const dcm::GroupView& g, const StretchLoad& load, solve::System& system);

}  // namespace acinus::coupling
