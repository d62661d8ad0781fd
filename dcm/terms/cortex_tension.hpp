#pragma once
/// Active tension of the cortex: myosin tension that does not depend on the stretch of the surface.

#include <span>

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds E = T A with the area A of the whole surface, force = -T dA/dx: the pressure within a round
/// cell is 2 T / R. Not in [VanLiedekerke2020]. Stiffness: the geometric part T/sqrt(3) (I - u u^T)
/// per edge (area.hpp); the rest of the Hessian is not definite. With a ring each triangle has the
/// tension T_f of its place and pulls with -T_f dA_f/dx. Material flows through the band, so this
/// force is no gradient of an energy; net force and torque still vanish.
void add_cortex_tension(const Params& p, const GroupView& g, solve::System& system);

/// Energy of one lane, fJ; with a ring sum T_f A_f, whose gradient at constant T_f is the force.
double cortex_tension_energy(const Params& p, const GroupView& g, int lane);

/// Ratio of the tension at an angle to the axis, given by its cosine, to that at the poles.
double ring_factor(const ContractileRing& c, double cosine);

/// Adds the active tension at the nodes of one lane, nN/um.
/// @param tension  [n_node]
void add_active_tension(const Params& p, const GroupView& g, int lane, std::span<double> tension);

}  // namespace acinus::dcm
