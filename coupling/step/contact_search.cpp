#include "coupling/step/contact_search.hpp"

#include "cbm/contact.hpp"
#include "cbm/pair_kernel.hpp"
#include "coupling/step/ghost_cells.hpp"
#include "coupling/world/contact_input.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_bodies.hpp"

namespace acinus::coupling {
namespace {

void refresh_lists(const InterfaceInput& in, Workspace& w) {
  const auto scope = w.timings.scope("contact lists");
  dcm::refresh_bodies(in.dcm.state, w.dcm);
  dcm::refresh_lists(in.dcm, w.dcm);
  cbm::refresh_pairs(in.cbm, w.cbm, w.system.ownership.ranks);
}

void search_contacts(const InterfaceInput& in, Workspace& w) {
  const auto scope = w.timings.scope("contacts");
  dcm::find_contacts(in.dcm, w.dcm, w.contacts);
  w.cbm.overlap_sum.clear();
  if (cbm::has_correction(in.cbm.params)) cbm::compute_overlaps(in.cbm, w.cbm);
  find_interface(in, w.dcm, w.cbm, w.interface, w.contacts);
  const SphereExchange spheres = plan_sphere_exchange(w);
  exchange_values(w, spheres, w.cbm.overlap_sum);
  exchange_values(w, spheres, w.cbm.overlap_count);
  if (in.dcm.options.law == dcm::ContactLaw::kMaugisDugdale)
    find_triangle_interface(in, w.dcm, w.cbm, w.interface, w.contacts);
  // A process knows of a ghost cell only its contacts with own cells: shares are exchanged.
  exchange_shares(w);
  cbm::find_contacts(in.cbm, w.cbm, w.contacts, w.system.point_links);
  exchange_values(w, spheres, w.cbm.coupling);
  cbm::add_coupling(w.cbm, w.contacts.of(contact::ContactKind::kSphereObstacle),
                    w.system.point_links);
  add_interface_areas(w.interface, w.cbm);
  dcm::find_nucleus_contacts(in.dcm, w.dcm, w.nuclei, w.contacts);
}

}  // namespace

void refresh_contacts(const World& world, const State& at, double end, Workspace& w) {
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = contact_input(world, at, phase, wall_time(world.state.clock, end), w);
  refresh_lists(in, w);
  search_contacts(in, w);
}

}  // namespace acinus::coupling
