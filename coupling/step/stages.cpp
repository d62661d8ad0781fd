#include "coupling/step/stages.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "cbm/contact.hpp"
#include "cbm/pair_kernel.hpp"
#include "contact/wall_mesh.hpp"
#include "core/parallel/arrays.hpp"
#include "coupling/migration/leaders.hpp"
#include "coupling/migration/migration.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/foreign.hpp"
#include "coupling/world/sharing.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_sides.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/node_friction.hpp"
#include "dcm/contact/triangle_contact.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/terms/medium.hpp"
#include "dcm/terms/nucleus_links.hpp"

namespace acinus::coupling {
namespace {

/// Contact parameters of the present phase.
struct PhaseParams {
  dcm::ContactParams dcm;
  cbm::ContactParams cbm;
  InterfaceParams interface;
};
PhaseParams phase_params(const World& world) {
  const Controls controls = controls_at(world.state.clock, world.params.start_up);
  PhaseParams p{world.params.dcm_contact, world.params.cbm_contact, world.params.interface};
  p.dcm.adhesion_factor = p.cbm.adhesion_factor = controls.adhesion;
  p.dcm.friction_factor = p.cbm.friction_factor = p.interface.friction_factor = controls.friction;
  return p;
}

/// What contact reads, in one place for all its functions.
/// @param wall_time  s, for which moving walls stand
InterfaceInput input_of(const World& world, const PhaseParams& phase, double wall_time,
                        const Workspace& w) {
  const State& s = world.state;
  const Params& p = world.params;
  const contact::Boundary& boundary = w.boundary ? *w.boundary : p.boundary;
  return {{s.dcm, p.dcm, phase.dcm, w.lanes, boundary, wall_time, tree_first_row(s)},
          {s.cbm,
           p.cbm,
           phase.cbm,
           {w.cbm_radius, w.cbm_strength, w.cbm_mother},
           boundary,
           wall_time,
           cbm_first_row(s),
           tree_first_row(s)},
          phase.interface};
}

/// Growth is tracked to the end of the step, so that slow motion leaves no lag.
void find_references(const State& s, double end, Workspace& w) {
  dcm::find_lane_data(s.dcm, end, w.lanes);
  cbm::find_radii(s.cbm, end, w.cbm_radius);
  cbm::find_strengths(s.cbm, end, w.cbm_strength);
  w.cbm_mother.clear();
  if (w.cbm_strength.empty() || s.cycle.empty()) return;
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    w.cbm_mother.push_back(s.cycle[s.dcm.n_lane() + c].parent);
}

void choose_leaders_of_step(const World& world, Workspace& w) {
  w.leader = world.state.leader;
  w.leader_interval = world.state.leader_interval;
  if (world.params.motility.leader_force > 0 && world.state.clock.phase == Phase::kRun)
    choose_leaders(world, w.lanes.radius, w.cbm_radius, w.leader, w.leader_interval);
}

void refresh_lists(const InterfaceInput& in, Workspace& w) {
  const auto scope = w.timings.scope("contact lists");
  dcm::refresh_bodies(in.dcm.state, w.dcm);
  dcm::refresh_lists(in.dcm, w.dcm);
  cbm::refresh_pairs(in.cbm, w.cbm);
}

void search_contacts(const InterfaceInput& in, Workspace& w) {
  const auto scope = w.timings.scope("contacts");
  dcm::find_contacts(in.dcm, w.dcm, w.contacts);
  dcm::find_nucleus_contacts(in.dcm, w.dcm, w.nuclei);
  w.cbm.overlap_sum.clear();
  if (cbm::has_correction(in.cbm.params)) cbm::find_overlaps(in.cbm, w.cbm);
  find_interface(in, w.dcm, w.cbm, w.interface, w.contacts);
  // Of what its cells share a contact with, each process knows only the contacts with these.
  exchange_shares(w);
  const SphereExchange spheres = plan_sphere_exchange(w);
  exchange_values(w, spheres, w.cbm.overlap_sum);
  exchange_values(w, spheres, w.cbm.overlap_count);
  cbm::find_contacts(in.cbm, w.cbm, w.contacts, w.system.point_links);
  exchange_values(w, spheres, w.cbm.coupling);
  cbm::add_coupling(w.cbm, std::span(w.contacts.all).subspan(w.contacts.interface_end),
                    w.system.point_links);
  add_interface_areas(w.interface, w.cbm);
}

/// Friction of every cell with the medium as a whole, nN s/um.
void sum_medium_friction(const World& world, const InterfaceInput& in, Workspace& w) {
  constexpr double kForeign = -1;
  const State& s = world.state;
  dcm::compute_medium_areas(in.dcm, w.dcm, w.medium_area);
  w.medium_friction.dcm.assign(s.dcm.n_lane(), 0.0);
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    if (w.dcm.is_foreign(l)) w.medium_friction.dcm[l] = kForeign;
    if (!s.dcm.active(l) || w.dcm.is_foreign(l)) continue;
    const dcm::Group& g = s.dcm.group[l / kLanes];
    double area = 0;
    for (int i = 0; i < g.topology->n_node; ++i)
      area += w.medium_area[(g.first_row + i) * kLanes + l % kLanes];
    w.medium_friction.dcm[l] =
        area * dcm::medium_friction_per_area(world.params.dcm[g.type], w.lanes.radius[l],
                                             g.topology->rest_area);
  }
  w.medium_friction.cbm.resize(s.cbm.n_cell());
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    w.medium_friction.cbm[c] = w.cbm.is_foreign(c)
                                   ? kForeign
                                   : cbm::medium_friction(world.params.cbm[s.cbm.type[c]],
                                                          w.cbm_radius[c], w.cbm.contact_area[c]);
}

/// Midpoint time of the step, s since t = 0; devices are evaluated there.
double middle_of(const World& world, double step) { return time_since_start(world) + 0.5 * step; }

/// Constants of the deformable cells in this step.
void compute_params(const World& world, double step, Workspace& w) {
  w.dcm_params = world.params.dcm;
  world.params.apparatus.set_params(middle_of(world, step), w.dcm_params);
  dcm::set_dashpots(world.state.dcm, w.dcm_params, w.system.block);
}

/// After all other contacts: those of nuclei have no record in the list of contacts.
void add_nuclei(const dcm::ContactInput& in, Workspace& w) {
  w.first_nucleus_link = w.system.links.size();
  if (!dcm::has_nuclei(in.state)) return;
  dcm::add_nucleus_links(in.state, w.dcm_params, in.lanes, w.system);
  dcm::add_nucleus_contacts(in, w.dcm, w.nuclei, w.system.links);
}

/// Vessels of the step are where the tree is.
void find_vessels(const World& world, Workspace& w) {
  if (world.state.tree.node.empty()) return;
  if (!w.boundary) w.boundary = world.params.boundary;
  place_vessels(world.params.tree, world.state.tree, w.boundary->vessels);
}

void add_tree(const World& world, Workspace& w) {
  if (world.state.tree.node.empty()) return;
  add_tree_loads(world.params.tree, world.state.tree, w.system.block.back(), w.system);
}

/// Rows of the nodes of the tree that are anchored, and of their rotations.
void find_anchored_rows(const World& world, Workspace& w) {
  w.constraint.anchored_row.clear();
  if (world.state.tree.node.empty()) return;
  const VesselTree& tree = world.params.tree;
  for (std::size_t i = 0; i < 2 * tree.n_node(); ++i)
    if (tree.anchored[i % tree.n_node()] != 0)
      w.constraint.anchored_row.push_back(tree_first_row(world.state) + i);
}

}  // namespace

void size_workspace(const World& world, Workspace& w) {
  const State& s = world.state;
  std::span<const std::uint8_t> constrained = w.constraint.cell;
  if (w.constraint.applies()) constrained = constrained.first(s.dcm.n_lane());
  std::vector<solve::Block> blocks = dcm::make_blocks(s.dcm, world.params.dcm, constrained);
  const std::vector<solve::Block> spheres = cbm::make_blocks(s.cbm);
  blocks.insert(blocks.end(), spheres.begin(), spheres.end());
  if (!s.tree.node.empty()) blocks.push_back({.pattern = &world.params.tree.pattern});
  find_anchored_rows(world, w);
  w.boundary.reset();
  dcm::size_rank_one(s.dcm, world.params.dcm, w.system, world.params.apparatus.count_rank_one());
  w.system.ownership = share_blocks(world, blocks, w.cost);
  solve::set_blocks(w.system, std::move(blocks));
  find_foreign_cells(world, w);
  w.active = active_lanes(s);
  assign_zeros(w.rhs, w.system.n_dof());
  assign_zeros(w.move, w.system.n_dof());
  ++w.sized;
  w.dcm.lane_of_body.clear();
  w.cbm.list_position.clear();
  w.dcm.fixed.clear();
  for (const contact::StaticMesh& m : world.params.boundary.meshes) w.dcm.fixed.push_back(m.body);
  if (world.params.boundary.vessels.wall)
    w.dcm.fixed.push_back(world.params.boundary.vessels.wall->surface.body);
}

void find_all_contacts(const World& world, double step, Workspace& w) {
  const Clock& clock = world.state.clock;
  const PhaseParams phase = phase_params(world);
  const double end = clock.time + step;
  find_vessels(world, w);
  find_references(world.state, end, w);
  apply_constraint(w);
  choose_leaders_of_step(world, w);
  const InterfaceInput in =
      input_of(world, phase, clock.phase == Phase::kRun ? end - clock.origin : 0, w);
  refresh_lists(in, w);
  search_contacts(in, w);
}

void assemble(const World& world, double step, Workspace& w, Selection selection) {
  const auto scope = w.timings.scope("assembly");
  const State& s = world.state;
  const Params& p = world.params;
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = input_of(world, phase, 0, w);
  w.system.friction_scale = selection.friction_factor / step;
  w.system.stiffness_scale = selection.stiffness_scale;
  solve::clear_loads(w.system);
  gather_positions(s, w.position);
  sum_medium_friction(world, in, w);
  compute_cell_forces(world, controls_at(s.clock, p.start_up), step, w.medium_friction, w.leader,
                      w.forces);

  compute_params(world, step, w);
  dcm::add_loads(s.dcm, w.dcm_params, w.lanes, w.medium_area, w.forces.dcm, w.system);
  p.apparatus.add_loads(middle_of(world, step), {s.dcm, w.lanes, w.system});
  cbm::add_cell_loads(in.cbm, w.cbm, w.forces.cbm, w.system);
  solve::Links& links = w.system.links;
  dcm::add_contact_loads(in.dcm, w.dcm, w.contacts, links);
  if (phase.dcm.law == dcm::ContactLaw::kMaugisDugdale)
    dcm::add_place_remainders(in.dcm, w.dcm, w.contacts, w.system.force);
  cbm::add_contact_loads(in.cbm, w.cbm, w.contacts, w.system);
  if (phase.dcm.friction_form == dcm::FrictionForm::kNodes)
    dcm::add_node_friction(in.dcm, w.dcm, w.contacts, w.system.point_links);
  if (selection.interface) add_interface_loads(in, w.dcm, w.cbm.modulus, w.contacts, links);
  add_nuclei(in.dcm, w);
  cbm::add_vessel_loads(in.cbm, w.contacts, links);
  add_tree(world, w);
  add_constraint(step, w);
  w.op.add_link_forces(w.system);
  w.op.prepare(w.system);
}

void list_sphere_pairs(const World& world, Workspace& w) {
  const PhaseParams phase = phase_params(world);
  w.contacts.all.resize(w.contacts.sphere_obstacle_end);
  cbm::list_pairs(input_of(world, phase, 0, w).cbm, w.cbm, w.contacts);
}

std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& w) {
  const PhaseParams phase = phase_params(world);
  std::vector<InterfaceForce> forces =
      compute_interface_forces(input_of(world, phase, 0, w), w.dcm, w.contacts);
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return forces;
  // Each by the owner of its deformable cell, in the order of these.
  std::map<std::int64_t, std::size_t> lane;
  for (const std::size_t l : w.dcm.lane_of_body) lane.emplace(world.state.dcm.lineage[l], l);
  const auto lane_of = [&lane](const InterfaceForce& f) { return lane.at(f.dcm_id); };
  std::erase_if(forces, [&](const InterfaceForce& f) { return w.dcm.is_foreign(lane_of(f)); });
  std::vector<InterfaceForce> all;
  ownership.ranks.gather<InterfaceForce>(forces, all);
  std::ranges::stable_sort(all, {}, lane_of);
  return all;
}

solve::Stencil stencil_of(const World& world, const Workspace& w, const contact::Contact& k) {
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = input_of(world, phase, 0, w);
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
