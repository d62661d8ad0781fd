#pragma once
/// Shell of a nucleus: the terms of a cortex with constants of its own.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Constants of the shell in the form of those of a cortex. Its nodal friction is that of the
/// cortex, since the solver has one per cell.
/// @param p  of the cell; @pre p.nucleus
Params nucleus_shell(const Params& p);

/// Adds springs, bending, and resistance to changes of volume and area: cortex.hpp, bending.hpp,
/// volume.hpp, area.hpp. Rows of empty lanes get a friction, so that the matrix is not singular.
/// @param nuclei       of view_nuclei
/// @param volume, area  null: no type has such a modulus
void add_nucleus_shell(const Params& shell, const GroupView& nuclei, solve::RankOne* volume,
                       solve::RankOne* area, solve::System& system);

/// Energy of one lane, fJ.
double nucleus_shell_energy(const Params& shell, const GroupView& nuclei, int lane);

}  // namespace acinus::dcm
