#pragma once
/// Outward stress on the surface of a cell by the angle to an axis, as exerted by two laser beams.

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct StretchLoad {
  Vec3 axis = Vec3::UnitX();  ///< unit
  double exponent = 2;        ///< n, of the cosine
  double stress = 0;          ///< kPa on the axis
};

/// Adds stress |cos alpha_i|^n dV/dx_i on every node. alpha_i is the angle between the axis and the
/// direction from the centre of the cell (mean of the nodes by rest area) to the node; dV/dx_i is
/// the area vector of the node. The remaining net force is removed, distributed by rest areas, so
/// that the cell stays between the beams. The torque is 0 for cells symmetric about the axis.
/// [VanLiedekerke2020, Eq. (32) with n = 2, and Appendix 3]
void add_stretch_load(const dcm::GroupView& g, const StretchLoad& load, solve::System& system);

}  // namespace acinus::coupling
