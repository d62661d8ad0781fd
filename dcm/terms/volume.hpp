#pragma once
/// Cytosol: resistance to volume change.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds the cytosol pressure, E = K_V (V ln(V/V0) - V + V0), p = -K_V ln(V/V0), force = p dV/dx
/// (the exact gradient; net force and torque are zero).   [VanLiedekerke2020, Eq. (11)] Stiffness:
/// (K_V / V) g g^T with g = dV/dx, rank one. -p d2V is indefinite and left out: with it in the
/// matrix, packed cells blew up. A volume at or below a thousandth of V0 is treated as that (the
/// step will be rejected).
void add_volume(const Params& p, const GroupView& g, solve::System& system, solve::RankOne& family);

/// Volumes of all lanes, um^3.
Lane compute_volumes(const GroupView& g);

/// Energy of one lane, fJ.
double volume_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
