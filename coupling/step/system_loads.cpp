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

/// Midpoint time of the step, s since t = 0; devices are evaluated there.
double middle_of(const World& world, double step) { return time_since_start(world) + 0.5 * step; }

/// Constants of the deformable cells in this step.
void refresh_params(const World& world, const State& at, double step, Workspace& w) {
  w.dcm_params = world.params.dcm;
  world.params.apparatus.set_params(middle_of(world, step), w.dcm_params);
  dcm::set_dashpots(at.dcm, w.dcm_params, w.system.block.front());
}

/// Positions of all points in one array of the state, if they are; else empty.
std::span<const double> positions_in_one(const State& at) {
  for (const HeldRows<double>* x : {&at.dcm.position, &at.cbm.position})
    if (x->size() == count_unknowns(at)) return *x;
  return {};
}

/// Finds the positions of all points, or with several processes of own points and of those in
/// contact with them.
void refresh_positions(const State& at, Workspace& w) {
  if (w.system.ownership.is_whole()) {
    w.position = positions_in_one(at);
    if (!w.position.empty()) return;
    gather_positions(at, w.gathered);
    w.position = w.gathered;
    return;
  }
  set_size(w.gathered, count_unknowns(at));
  w.position = w.gathered;
  const auto copy = [&](std::size_t k) {
    w.gathered[k] = *position_of(at, static_cast<Address>(k));
  };
  for_each_own_number(w.system, copy);
  for (const solve::Point p : w.op.ghost_points())
    for (std::size_t k = 0; k < 3; ++k)
      copy(static_cast<std::size_t>(solve::address_of(p)) + k * kLanes);
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
  refresh_params(world, at, step, w);
  dcm::add_loads(at.dcm, w.dcm_params, w.lanes, w.medium_area, w.forces.dcm, w.system);
  world.params.apparatus.add_loads(middle_of(world, step), {at.dcm, w.lanes, w.system});
  cbm::add_cell_loads(in.cbm, w.cbm, w.forces.cbm, w.system);
  add_contacts(in, terms, w);
  if (!at.tree.node.empty())
    add_tree_loads(world.params.tree, at.tree, w.system.block[w.tree_block], w.system);
  add_constraint(step, w);
  w.op.add_link_forces(w.system, [&](std::size_t link) -> Vec3 {
    const contact::Contact& k = w.contacts.all[w.system.links.law[link].contact];
    return k.force * k.normal;
  });
  w.op.prepare(w.system);
  refresh_positions(at, w);
}

}  // namespace acinus::coupling
