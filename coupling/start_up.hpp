#pragma once
/// Start-up: small seeds grow to size without adhesion, adhesion ramps up, the tissue settles. Its
/// end is t = 0.

#include <string>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Shrinks every cell to the initial radius and starts the growth phase. Centres stay.
void begin_start_up(World& world, double initial_radius);

/// Time to the end of the present phase or to the next check of a settling tissue, s; infinite in
/// Phase::kRun.
double time_to_phase_event(const World& world);

/// Enters the next phase at the end of the present one. The settling phase ends as soon as nodes
/// are slower than the speed tolerance and pressures change by less than the pressure tolerance, or
/// at its time limit. begin_life is left to the caller in Phase::kRun, since other runs may start
/// from the state before it.
/// @return message about the change of phase; empty if there is none
std::string update_phase(World& world, Workspace& work);

}  // namespace acinus::coupling
