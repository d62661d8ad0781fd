#pragma once
/// Membrane: resistance to changes of the area of every single triangle, for mesh quality.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds E = K (a - a0)^2 / (2 a0) per triangle, force = -dE/dx.   [VanLiedekerke2020,
/// section 2.1.2: reference area per triangle] Stiffness: (K / a0) g g^T over the three nodes.
void add_local_area(const Params& p, const GroupView& g, solve::System& system);

/// Energy of one lane, fJ.
double local_area_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
