#pragma once
/// Active tension of the cortex: myosin pulls with the same tension however far the surface is
/// stretched.

#include <span>

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds E = T A with the area A of the whole surface, force = -T dA/dx: the pressure within a round
/// cell is 2 T / R. Not in [VanLiedekerke2020]. Stiffness: T/sqrt(3) (I - u u^T) per edge, what
/// holds the surface flat (area.hpp); the rest of the Hessian is not definite. With a ring each
/// triangle has the tension T_f of its place and pulls with -T_f dA_f/dx. What it is made of flows
/// through the band, so there is no energy whose gradient this were; force and torque still vanish.
void add_cortex_tension(const Params& p, const GroupView& g, solve::System& system);

/// Energy of one lane, fJ; with a ring sum T_f A_f, whose gradient at constant T_f is the force.
double cortex_tension_energy(const Params& p, const GroupView& g, int lane);

/// Tension where the angle to the axis has this cosine, over that at the poles.
double ring_factor(const ContractileRing& c, double cosine);

/// Adds the active tension at the nodes of one lane, nN/um.
/// @param tension  [n_node]
void add_active_tension(const Params& p, const GroupView& g, int lane, std::span<double> tension);

}  // namespace acinus::dcm
