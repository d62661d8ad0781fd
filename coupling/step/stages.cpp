#include "coupling/step/stages.hpp"

#include <span>
#include <utility>

#include "coupling/leaders.hpp"
#include "dcm/node_friction.hpp"
#include "dcm/terms/medium.hpp"

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

InterfaceView view_interface(const World& world, const PhaseParams& phase, const Workspace& w) {
  return {world.state.dcm, world.params.dcm, phase.dcm,        w.lanes,
          w.dcm,           world.state.cbm,  world.params.cbm, w.cbm_radius,
          w.cbm.modulus,   phase.interface,  w.interface};
}

/// Growth is tracked to the end of the step, so that slow motion leaves no lag.
void find_references(const State& s, double end, Workspace& w) {
  w.lanes = dcm::make_lane_data(s.dcm, end);
  w.cbm_radius = cbm::radii_at(s.cbm, end);
  w.cbm_strength = cbm::strengths_at(s.cbm, end);
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

void refresh_lists(const World& world, const PhaseParams& phase, Workspace& w) {
  const auto scope = w.timings.scope("contact lists");
  const State& s = world.state;
  const contact::Surroundings& around = world.params.around;
  dcm::refresh_bodies(s.dcm, w.dcm);
  dcm::refresh_lists(s.dcm, phase.dcm, w.lanes, around, w.dcm);
  cbm::refresh_pairs(s.cbm, world.params.cbm, phase.cbm, w.cbm_radius, around, w.cbm);
}

/// @param wall_time  s, for which moving walls stand
void search_contacts(const World& world, const PhaseParams& phase, double wall_time, Workspace& w) {
  const auto scope = w.timings.scope("contacts");
  const State& s = world.state;
  const contact::Surroundings& around = world.params.around;
  const cbm::CellData spheres{w.cbm_radius, w.cbm_strength, w.cbm_mother};
  dcm::find_contacts(s.dcm, phase.dcm, w.lanes, around, wall_time, w.dcm);
  w.cbm.overlap_sum.clear();
  if (cbm::has_correction(world.params.cbm))
    cbm::find_overlaps(s.cbm, spheres, around, wall_time, w.cbm);
  find_interface(s.dcm, phase.dcm, w.lanes, s.cbm, w.cbm_radius, w.dcm, w.cbm, w.interface);
  cbm::find_contacts(s.cbm, world.params.cbm, phase.cbm, spheres, around, wall_time,
                     cbm_first_row(s), w.cbm, w.system.point_links);
  add_interface_areas(w.interface, w.cbm);
}

/// Friction of every cell with the medium as a whole, nN s/um.
void sum_medium_friction(const World& world, const PhaseParams& phase, Workspace& w) {
  const State& s = world.state;
  dcm::compute_medium_areas(s.dcm, phase.dcm, w.lanes, w.dcm, w.medium_area);
  w.dcm_medium.assign(s.dcm.n_lane(), 0.0);
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    if (!s.dcm.active(l)) continue;
    const dcm::Group& g = s.dcm.group[l / kLanes];
    double area = 0;
    for (int i = 0; i < g.topology->n_node; ++i)
      area += w.medium_area[(g.first_row + static_cast<std::size_t>(i)) * kLanes + l % kLanes];
    w.dcm_medium[l] =
        area * dcm::medium_friction_per_area(world.params.dcm[static_cast<std::size_t>(g.type)],
                                             w.lanes.radius[l], g.topology->rest_area);
  }
  w.cbm_medium.resize(s.cbm.n_cell());
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    w.cbm_medium[c] =
        cbm::medium_friction(world.params.cbm[static_cast<std::size_t>(s.cbm.type[c])],
                             w.cbm_radius[c], w.cbm.contact_area[c]);
}

}  // namespace

void size_workspace(const World& world, Workspace& w) {
  const State& s = world.state;
  std::span<const std::uint8_t> constrained = w.constraint.cell;
  if (w.constraint.applies()) constrained = constrained.first(s.dcm.n_lane());
  std::vector<solve::Block> blocks = dcm::make_blocks(s.dcm, world.params.dcm, constrained);
  const std::vector<solve::Block> spheres = cbm::make_blocks(s.cbm);
  blocks.insert(blocks.end(), spheres.begin(), spheres.end());
  dcm::size_rank_one(s.dcm, world.params.dcm, w.system);
  w.system.halo.ranks = world.ranks;
  solve::set_blocks(w.system, std::move(blocks));
  w.active = active_lanes(s);
  w.rhs.assign(w.system.n_dof(), 0.0);
  w.move.assign(w.system.n_dof(), 0.0);
  w.trial.reset();
  w.awake.reset();
  w.sleepers.reset();
  w.dcm.body.clear();
  w.dcm.lane_of_body.clear();
  w.cbm.list_position.clear();
  w.dcm.fixed.clear();
  for (const contact::StaticMesh& m : world.params.around.meshes) w.dcm.fixed.push_back(m.body);
}

void find_all_contacts(const World& world, double step, Workspace& w) {
  const Clock& clock = world.state.clock;
  const PhaseParams phase = phase_params(world);
  const double end = clock.time + step;
  find_references(world.state, end, w);
  apply_constraint(w);
  choose_leaders_of_step(world, w);
  refresh_lists(world, phase, w);
  search_contacts(world, phase, clock.phase == Phase::kRun ? end - clock.origin : 0, w);
}

void assemble(const World& world, double step, Workspace& w, Selection selection) {
  const auto scope = w.timings.scope("assembly");
  const State& s = world.state;
  const Params& p = world.params;
  const PhaseParams phase = phase_params(world);
  const std::size_t first = cbm_first_row(s);
  w.system.friction_scale = selection.friction_factor / step;
  w.system.stiffness_scale = selection.stiffness_scale;
  solve::clear_loads(w.system);
  gather_positions(s, w.position);
  sum_medium_friction(world, phase, w);
  compute_cell_forces(world, controls_at(s.clock, p.start_up), step, w.dcm_medium, w.cbm_medium,
                      w.leader, w.forces);

  dcm::add_loads(s.dcm, p.dcm, w.lanes, w.medium_area, w.forces.dcm, w.system);
  cbm::add_cell_loads(s.cbm, p.cbm, w.cbm_radius, w.cbm, w.forces.cbm, first, w.system);
  solve::Links& links = w.system.links;
  dcm::add_contact_loads(s.dcm, p.dcm, phase.dcm, w.lanes, p.around, w.dcm, links);
  cbm::add_contact_loads(s.cbm, p.cbm, p.around, w.cbm, first, w.system);
  if (phase.dcm.friction_form == dcm::FrictionForm::kNodes)
    dcm::add_node_friction(s.dcm, phase.dcm, w.lanes, w.dcm, w.system.point_links);
  if (selection.interface) add_interface_loads(view_interface(world, phase, w), first, links);
  add_constraint(step, w);
  w.op.add_link_forces(w.system);
  w.op.prepare(w.system);
}

std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& w) {
  const PhaseParams phase = phase_params(world);
  return compute_interface_forces(view_interface(world, phase, w));
}

std::vector<cbm::SphereContact> sphere_contacts(const World& world, const Workspace& w) {
  return cbm::list_sphere_contacts(world.state.cbm, world.params.cbm, phase_params(world).cbm,
                                   {w.cbm_radius, w.cbm_strength, w.cbm_mother}, w.cbm);
}

}  // namespace acinus::coupling
