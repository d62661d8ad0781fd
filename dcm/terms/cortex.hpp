#pragma once
/// Cortex: Kelvin-Voigt springs along the edges.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds edge springs, E = 1/2 k_s (l - l0)^2, force = -dE/dx, and dashpots between the same nodes,
/// isotropic or along the edge.   [VanLiedekerke2020, Eq. (2), (3)]
/// Stiffness per edge: k_s u u^T + max(0, k_s (1 - l0/l)) (I - u u^T): a compressed spring's
/// negative geometric part is dropped so that the matrix stays semi-definite.
/// @pre no edge has zero length
void add_cortex(const Params& p, const GroupView& g, solve::System& system);

/// Spring energy of one lane, fJ.
double cortex_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
