#include "coupling/measure/pair_contacts.hpp"

#include <algorithm>

#include "cbm/pair_kernel.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/contact_input.hpp"
#include "dcm/contact/contact_sides.hpp"

namespace acinus::coupling {

void visit_sphere_pairs(const World& world, const Workspace& w,
                        const std::function<void(const contact::Contact&)>& visit) {
  const PhaseParams phase = phase_params(world);
  cbm::visit_pairs(contact_input(world, world.state, phase, 0, w).cbm, w.cbm, visit);
}

std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& w) {
  const PhaseParams phase = phase_params(world);
  std::vector<InterfaceForce> forces =
      compute_interface_forces(contact_input(world, world.state, phase, 0, w), w.dcm, w.contacts);
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return forces;
  // Each pair comes from the owner of its deformable cell, in the order of these cells.
  const CellIndex cells = index_cells(world.state);
  const auto lane_of = [&cells](const InterfaceForce& f) { return cells.at(f.dcm_id).at; };
  std::erase_if(forces, [&](const InterfaceForce& f) { return w.dcm.is_ghost(lane_of(f)); });
  std::vector<InterfaceForce> all;
  ownership.ranks.gather<InterfaceForce>(forces, all);
  std::ranges::stable_sort(all, {}, lane_of);
  return all;
}

solve::Stencil stencil_of(const World& world, const Workspace& w, const contact::Contact& k) {
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = contact_input(world, world.state, phase, 0, w);
  solve::Link link;
  if (k.point == contact::kWhole) {
    link.a = solve::Side::at(cbm::cell_point(in.cbm.first_row, k.a));
  } else {
    link.a = dcm::side_a(in.dcm, w.dcm, k);
  }
  link.b =
      k.partner == contact::Partner::kSphere ? sphere_side(in, k) : dcm::side_b(in.dcm, w.dcm, k);
  return solve::stencil_of(link);
}

}  // namespace acinus::coupling
