#include "coupling/world/contact_input.hpp"

namespace acinus::coupling {

PhaseParams phase_params(const World& world) {
  const Controls controls = controls_at(world.state.clock, world.params.start_up);
  PhaseParams p{world.params.dcm_contact, world.params.cbm_contact, world.params.interface};
  p.dcm.adhesion_factor = p.cbm.adhesion_factor = controls.adhesion;
  p.dcm.friction_factor = p.cbm.friction_factor = p.interface.friction_factor = controls.friction;
  return p;
}

InterfaceInput contact_input(const World& world, const State& at, const PhaseParams& phase,
                             double wall_time, const Workspace& w) {
  const Params& p = world.params;
  const contact::Boundary& boundary = w.boundary ? *w.boundary : p.boundary;
  const std::span<const double> adhesion = at.adhesion;
  const bool responds = !adhesion.empty();
  const std::size_t n_lane = at.dcm.n_lane();
  return {
      {at.dcm, p.dcm, phase.dcm, w.lanes, boundary, wall_time, tree_first_row(at),
       responds ? adhesion.first(n_lane) : adhesion},
      {at.cbm,
       p.cbm,
       phase.cbm,
       {w.cbm_radius, w.cbm_strength, w.cbm_mother, responds ? adhesion.subspan(n_lane) : adhesion},
       boundary,
       wall_time,
       cbm_first_row(at),
       tree_first_row(at)},
      phase.interface};
}

}  // namespace acinus::coupling
