#pragma once
/// Start-up: small seeds grow to size without adhesion, then adhesion ramps up, then the tissue
/// comes to rest; that moment is t = 0.

#include <string>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Shrinks every cell to the initial radius and starts the growth phase. Centres stay.
void begin_start_up(World& world, double initial_radius);

/// Time left until the present phase or its next look at the tissue ends, s; infinite in
/// Phase::kRun.
double time_to_phase_event(const World& world);

/// Moves on to the next phase when its time has come. Returns what happened, empty if nothing.
/// The settling phase ends when nodes move slower than the speed tolerance and pressures change by
/// less than the pressure tolerance, or at its cap, which the returned text says. Life begins with
/// begin_life, which the caller calls in Phase::kRun: between the two stands the state that other
/// runs may start from.
std::string update_phase(World& world, Workspace& work);

}  // namespace acinus::coupling
