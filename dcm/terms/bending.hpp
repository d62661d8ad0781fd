#pragma once
/// Cortex: bending resistance of the hinge at every edge.

#include "core/solve/system.hpp"
#include "dcm/group_view.hpp"
#include "dcm/params.hpp"

namespace acinus::dcm {

/// Adds hinges, E = k_b (1 - cos(theta - theta0)), moment k_b sin(theta - theta0), with theta0 the
/// angle of the rest shape. Forces are the exact gradient, so net force and torque vanish.
/// [VanLiedekerke2020, Eq. (9)]
/// Stiffness: k_b max(0, cos(theta - theta0)) grad theta grad theta^T (Gauss-Newton).
void add_bending(const Params& p, const GroupView& g, solve::System& system);

/// Bending energy of one lane, fJ.
double bending_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
