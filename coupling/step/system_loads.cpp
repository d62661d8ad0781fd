#include "coupling/step/system_loads.hpp"

#include "cbm/contact.hpp"
#include "cbm/pair_kernel.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/world/contact_input.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/node_friction.hpp"
#include "dcm/contact/triangle_contact.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/terms/nucleus_links.hpp"

namespace acinus::coupling {
namespace {

/// The time of a step whose middle decides what holds in it, s since t = 0.
double middle_of(const World& world, double step) { return time_since_start(world) + 0.5 * step; }

/// Steps end where a course jumps, so its value in their middle is of second order.
void find_params(const World& world, const State& at, double step, Workspace& w) {
  w.dcm_params = world.params.dcm;
  set_temperature(world.params.temperature, middle_of(world, step), w.dcm_params);
  for (dcm::Params& p : w.dcm_params)
    if (p.contraction)
      p.cortex_tension *= contraction_factor(*p.contraction, middle_of(world, step));
  dcm::set_dashpots(at.dcm, w.dcm_params, w.system.block);
}

void add_stretch(const World& world, const State& at, double step, Workspace& w) {
  const dcm::StretchLoad load = stretch_at(world.params.stretcher, middle_of(world, step));
  if (load.stress > 0) dcm::add_stretch_loads(at.dcm, w.lanes, load, w.system);
}

void add_suction(const World& world, const State& at, double step, Workspace& w) {
  const dcm::SuctionLoad load = suction_at(world.params.suction, middle_of(world, step));
  if (load.pressure > 0) dcm::add_suction_loads(at.dcm, w.lanes, load, w.system);
}

void add_pull_springs(const World& world, const State& at, double step, Workspace& w) {
  if (world.state.clock.phase != Phase::kRun || !any_spring(world.params.pulls)) return;
  find_springs(world.params.pulls, middle_of(world, step), at.dcm, w.pull_spring);
  dcm::add_pull_spring_loads(at.dcm, w.lanes, w.pull_spring, w.system);
}

/// Loads within the deformable cells and on them.
void add_cell_loads(const World& world, const State& at, double step, Workspace& w) {
  dcm::add_loads(at.dcm, w.dcm_params, w.lanes, w.medium_area, w.forces.dcm, w.system);
  add_stretch(world, at, step, w);
  add_suction(world, at, step, w);
  add_pull_springs(world, at, step, w);
}

void add_nuclei(const dcm::ContactInput& in, Workspace& w) {
  if (!dcm::has_nuclei(in.state)) return;
  dcm::add_nucleus_links(in.state, w.dcm_params, in.lanes, w.system);
  dcm::add_nucleus_contacts(in, w.dcm, w.contacts, w.system.links);
}

void add_contacts(const InterfaceInput& in, const SystemTerms& terms, Workspace& w) {
  solve::Links& links = w.system.links;
  dcm::add_contact_loads(in.dcm, w.dcm, w.contacts, links);
  if (in.dcm.options.law == dcm::ContactLaw::kMaugisDugdale)
    dcm::add_place_remainders(in.dcm, w.dcm, w.contacts, w.system.force);
  cbm::add_contact_loads(in.cbm, w.cbm, w.contacts, w.system);
  if (in.dcm.options.friction_form == dcm::FrictionForm::kNodes)
    dcm::add_node_friction(in.dcm, w.dcm, w.contacts, w.system.point_links);
  if (terms.interface) add_interface_loads(in, w.dcm, w.cbm.modulus, w.contacts, links);
  add_nuclei(in.dcm, w);
  cbm::add_vessel_loads(in.cbm, w.contacts, links);
}

}  // namespace

void add_loads(const World& world, const State& at, double step, const SystemTerms& terms,
               Workspace& w) {
  const auto scope = w.timings.scope("assembly");
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = contact_input(world, at, phase, 0, w);
  w.system.friction_scale = 1 / step;
  w.system.stiffness_scale = terms.stiffness ? 1 : 0;
  solve::clear_loads(w.system);
  gather_positions(at, w.position);
  find_params(world, at, step, w);
  add_cell_loads(world, at, step, w);
  cbm::add_cell_loads(in.cbm, w.cbm, w.forces.cbm, w.system);
  add_contacts(in, terms, w);
  if (!at.tree.node.empty())
    add_tree_loads(world.params.tree, at.tree, w.system.block[w.tree_block], w.system);
  add_constraint(step, w);
  w.op.add_link_forces(w.system);
  w.op.prepare(w.system);
}

}  // namespace acinus::coupling
