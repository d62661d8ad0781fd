#pragma once
/// Active tension of the cortex: myosin pulls with the same tension however far the surface is
/// stretched.

#include "core/solve/system.hpp"
#include "dcm/group_view.hpp"
#include "dcm/params.hpp"

namespace acinus::dcm {

/// Adds E = T A with the area A of the whole surface, force = -T dA/dx: the pressure within a round
/// cell is 2 T / R. Not in [VanLiedekerke2020]. Stiffness: T/sqrt(3) (I - u u^T) per edge, what
/// holds the surface flat (area.hpp); the rest of the Hessian is not definite.
void add_cortex_tension(const Params& p, const GroupView& g, solve::System& system);

/// Energy of one lane, fJ.
double cortex_tension_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
