#pragma once
/// Input of the contact search and of contact loads, the same for both models and their interface.

#include "coupling/interface/interface.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Contact parameters with the adhesion and the friction of the present phase of the run.
struct PhaseParams {
  dcm::ContactParams dcm;
  cbm::ContactParams cbm;
  InterfaceParams interface;
};
PhaseParams phase_params(const World& world);

/// Views of everything that contacts depend on; `phase` must outlive them.
/// @param at         positions of all cells
/// @param wall_time  s since t = 0, time of the positions of moving walls
/// @pre the references in `work` are those of the step
InterfaceInput contact_input(const World& world, const State& at, const PhaseParams& phase,
                             double wall_time, const Workspace& work);

}  // namespace acinus::coupling
