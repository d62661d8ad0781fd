#include "coupling/step.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/threads.hpp"
#include "coupling/awake.hpp"
#include "coupling/integrators.hpp"
#include "coupling/judge.hpp"
#include "coupling/leaders.hpp"
#include "coupling/partitioned.hpp"
#include "dcm/node_friction.hpp"
#include "dcm/terms/medium.hpp"

namespace acinus::coupling {
namespace {

/// Iterations per solve above which the coarse space is switched on, and below which it is switched
/// off again.
constexpr int kCoarseOn = 60, kCoarseOff = 15;

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

/// Whether the next step is worth a coarse space. It is of use where cells with many nodes hang
/// together; spheres alone are as well served by their diagonal blocks.
bool want_coarse(const State& s, int iterations_per_solve) {
  if (s.dcm.group.empty()) return false;
  return iterations_per_solve > (s.clock.coarse ? kCoarseOff : kCoarseOn);
}

void commit(World& world, double step, int cg_iterations, int solves, Workspace& w) {
  State& s = world.state;
  move_points(s, w.move);
  std::swap(s.cbm.touching, w.cbm.touching);
  s.leader = w.leader;
  s.leader_interval = w.leader_interval;
  s.last_move.resize(w.move.size());
  for_each_number(w.move.size(), [&](std::size_t k) { s.last_move[k] = w.move[k]; });
  s.clock.time += step;
  s.clock.last_step = step;
  s.clock.accepted += 1;
  s.clock.cg_iterations += cg_iterations;
  s.clock.solves += solves;
  s.clock.coarse = want_coarse(s, cg_iterations / std::max(solves, 1));
}

/// Cells that sleep exert no forces of their own.
void hold_sleepers(const State& s, Workspace& w) {
  w.held.clear();
  if (w.holds) w.held = s.asleep;
  w.dcm.held.clear();
  if (w.held.empty()) return;
  w.held.resize(w.active.size(), 0);
  w.dcm.held.assign(w.held.begin(), w.held.begin() + static_cast<std::ptrdiff_t>(s.dcm.n_lane()));
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (w.dcm.held[l] != 0) w.lanes.active[l] = 0;
}

/// What a held point resists with, nN/um: so much more than anything pushes with that nobody feels
/// it move, and little enough for the solver. What it moves in the solution is left out: add_holds
/// makes the force that holds it, place_held its place.
constexpr double kHold = 1e6;

/// Calls f with the row and the lane of every point that is held.
template <class F>
void for_each_held_point(const Workspace& w, F f) {
  for (std::size_t lane = 0; lane < w.held.size(); ++lane) {
    const solve::Block& b = w.system.block[lane / kLanes];
    if (w.held[lane] == 0 && !b.still) continue;  // with the empty lanes beside those held
    for (int i = 0; i < b.pattern->n_point; ++i)
      f(b.first_row + static_cast<std::size_t>(i), lane % kLanes);
  }
}

/// Ties every point of a held cell to its place.
void add_holds(double step, Workspace& w) {
  for_each_held_point(w, [&](std::size_t row, std::size_t lane) {
    w.system.medium[row * kLanes + lane] += kHold * step;
  });
}

/// Held cells go exactly where they are to go, however many steps push at them.
/// @param move  [n_row][3][lane] um; empty: they stay where they are
void place_held(Workspace& w, std::span<const double> move) {
  for_each_held_point(w, [&](std::size_t row, std::size_t lane) {
    const Address a = make_address(row, static_cast<int>(lane));
    store_point(w.move.data(), a, move.empty() ? Vec3::Zero() : load_point(move.data(), a));
  });
}

/// Length of the next step from the error of this one. A quarter more or less is not worth a
/// change.
double next_step(const Numerics& n, double step, double error) {
  if (!n.adaptive) return n.max_step;
  const double factor =
      error > 0 ? std::clamp(0.9 * std::sqrt(n.tolerance / error), 0.5, 1.5) : 1.5;
  return std::clamp(step * factor, n.min_step, n.max_step);
}

}  // namespace

void size_workspace(const World& world, Workspace& w) {
  std::vector<solve::Block> blocks =
      dcm::make_blocks(world.state.dcm, world.params.dcm,
                       w.holds ? world.state.asleep : std::span<const std::uint8_t>{});
  const std::vector<solve::Block> spheres = cbm::make_blocks(world.state.cbm);
  blocks.insert(blocks.end(), spheres.begin(), spheres.end());
  dcm::size_rank_one(world.state.dcm, world.params.dcm, w.system);
  w.system.halo.ranks = world.ranks;
  solve::set_blocks(w.system, std::move(blocks));
  w.active = active_lanes(world.state);
  w.rhs.assign(w.system.n_dof(), 0.0);
  w.move.assign(w.system.n_dof(), 0.0);
  w.stages.reset();
  w.awake.reset();
  w.sleepers.reset();
  w.dcm.body.clear();
  w.dcm.lane_of_body.clear();
  w.cbm.list_position.clear();
  w.dcm.fixed.clear();
  for (const contact::StaticMesh& m : world.params.around.meshes) w.dcm.fixed.push_back(m.body);
}

void find_all_contacts(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  const contact::Surroundings& around = world.params.around;
  const PhaseParams phase = phase_params(world);
  // Growth and moving walls are tracked to the end of the step, so that slow motion leaves no lag.
  const double end = s.clock.time + step;
  const double wall_time = s.clock.phase == Phase::kRun ? end - s.clock.origin : 0;
  w.lanes = dcm::make_lane_data(s.dcm, end);
  w.cbm_radius = cbm::radii_at(s.cbm, end);
  w.cbm_strength = cbm::strengths_at(s.cbm, end);
  w.cbm_mother.clear();
  if (!w.cbm_strength.empty() && !s.cycle.empty())
    for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
      w.cbm_mother.push_back(s.cycle[s.dcm.n_lane() + c].parent);
  const cbm::CellData spheres{w.cbm_radius, w.cbm_strength, w.cbm_mother};
  hold_sleepers(s, w);
  w.leader = s.leader;
  w.leader_interval = s.leader_interval;
  if (world.params.motility.leader_force > 0 && s.clock.phase == Phase::kRun)
    choose_leaders(world, w.lanes.radius, w.cbm_radius, w.leader, w.leader_interval);
  {
    const auto scope = w.timings.scope("contact lists");
    dcm::refresh_bodies(s.dcm, w.dcm);
    dcm::refresh_lists(s.dcm, phase.dcm, w.lanes, around, w.dcm);
    cbm::refresh_pairs(s.cbm, world.params.cbm, phase.cbm, w.cbm_radius, around, w.cbm);
  }
  const auto scope = w.timings.scope("contacts");
  dcm::find_contacts(s.dcm, phase.dcm, w.lanes, around, wall_time, w.dcm);
  w.cbm.overlap_sum.clear();
  if (cbm::has_correction(world.params.cbm))
    cbm::find_overlaps(s.cbm, spheres, around, wall_time, w.cbm);
  find_interface(s.dcm, phase.dcm, w.lanes, s.cbm, w.cbm_radius, w.dcm, w.cbm, w.interface);
  cbm::find_contacts(s.cbm, world.params.cbm, phase.cbm, spheres, around, wall_time,
                     cbm_first_row(s), w.cbm, w.system.point_links);
  add_interface_areas(w.interface, w.cbm);
}

void assemble(const World& world, double step, Workspace& w, Selection selection) {
  const auto scope = w.timings.scope("assembly");
  const State& s = world.state;
  const PhaseParams phase = phase_params(world);
  const std::size_t first = cbm_first_row(s);
  w.system.friction_scale = selection.friction_factor / step;
  w.system.stiffness_scale = selection.stiffness_scale;
  solve::clear_loads(w.system);
  gather_positions(s, w.position);

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
  compute_cell_forces(world, controls_at(s.clock, world.params.start_up), step, w.dcm_medium,
                      w.cbm_medium, w.leader, w.forces);

  dcm::add_loads(s.dcm, world.params.dcm, w.lanes, w.medium_area, w.forces.dcm, w.system);
  cbm::add_cell_loads(s.cbm, world.params.cbm, w.cbm_radius, w.cbm, w.forces.cbm, first, w.system);
  solve::Links& links = w.system.links;
  dcm::add_contact_loads(s.dcm, world.params.dcm, phase.dcm, w.lanes, world.params.around, w.dcm,
                         links);
  cbm::add_contact_loads(s.cbm, world.params.cbm, world.params.around, w.cbm, first, w.system);
  if (phase.dcm.friction_form == dcm::FrictionForm::kNodes)
    dcm::add_node_friction(s.dcm, phase.dcm, w.lanes, w.dcm, w.system.point_links);
  if (selection.interface) add_interface_loads(view_interface(world, phase, w), first, links);
  add_holds(step, w);
  w.op.add_link_forces(w.system);
  w.op.prepare(w.system);
}

void leave_out_holds(const Workspace& w, std::span<const double> move, std::span<double> product) {
  for_each_held_point(w, [&](std::size_t row, std::size_t lane) {
    const Address a = make_address(row, static_cast<int>(lane));
    add_point(product.data(), a, -kHold * load_point(move.data(), a));
  });
}

std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& w) {
  const PhaseParams phase = phase_params(world);
  return compute_interface_forces(view_interface(world, phase, w));
}

std::vector<cbm::SphereContact> sphere_contacts(const World& world, const Workspace& w) {
  return cbm::list_sphere_contacts(world.state.cbm, world.params.cbm, phase_params(world).cbm,
                                   {w.cbm_radius, w.cbm_strength, w.cbm_mother}, w.cbm);
}

namespace {

/// Solves for the whole displacement from the guess in w.move.
Status solve_from_guess(const World& world, Workspace& w, int& cg_iterations) {
  for_each_number(w.rhs.size(), [&](std::size_t k) {
    w.rhs[k] = w.system.force[k] + w.system.external_force[k];
  });
  if (!w.ahead.used()) return solve_system(world, w, cg_iterations);
  // A (d - ahead) = F - Gamma/h ahead, solved for d: the tolerance refers to the whole way. Of
  // what is held the way is known: its ties would drown all other forces.
  w.way.resize(w.move.size());
  for_each_number(w.rhs.size(), [&](std::size_t k) { w.way[k] = w.ahead.move[k]; });
  std::swap(w.way, w.move);
  place_held(w, {});
  w.op.apply(w.move, w.ahead.product);
  std::swap(w.way, w.move);
  place_held(w, {});
  for_each_number(w.rhs.size(),
                  [&](std::size_t k) { w.rhs[k] += w.ahead.product[k] - w.ahead.friction[k]; });
  const Status status = solve_system(world, w, cg_iterations);
  for_each_number(w.rhs.size(), [&](std::size_t k) { w.rhs[k] -= w.ahead.product[k]; });
  place_held(w, w.ahead.move);
  return status;
}

}  // namespace

Status solve_step(const World& world, double step, Workspace& w, int& cg_iterations) {
  const State& s = world.state;
  if (w.ahead.used()) {
    for_each_number(w.move.size(), [&](std::size_t k) { w.move[k] = w.ahead.move[k]; });
  } else if (has_last_move(s)) {  // the last step's velocity is a good first guess
    const double ratio = step / s.clock.last_step;
    for_each_number(w.move.size(), [&](std::size_t k) { w.move[k] = ratio * s.last_move[k]; });
  } else {
    std::ranges::fill(w.move, 0.0);
  }
  place_held(w, {});  // a guess their ties would make a huge force of
  return solve_from_guess(world, w, cg_iterations);
}

Status solve_again(const World& world, Workspace& w, int& cg_iterations) {
  place_held(w, {});
  return solve_from_guess(world, w, cg_iterations);
}

Status solve_system(const World& world, Workspace& w, int& cg_iterations) {
  const auto scope = w.timings.scope("solve");
  const solve::CgOptions& options = world.params.numerics.cg;
  const bool coarse = world.state.clock.coarse;
  if (coarse) w.coarse.prepare(w.op, w.position, w.active);
  const solve::CgResult result =
      w.partitioned
          ? solve_partitioned(w.op, w.rhs, w.move, world.state.dcm.group.size(), options, w.cg)
          : solve::solve_cg(w.op, w.rhs, w.move, options, w.cg, {}, coarse ? &w.coarse : nullptr);
  cg_iterations += result.iterations;
  if (!result.status.ok) return result.status;
  // A rigid error this small next to the edge of a mesh is below the solver's own tolerance.
  const solve::RigidResult rigid = solve::correct_rigid_modes(
      w.op, w.cg.residual, w.move, w.position, w.active, options.tolerance, w.rigid);
  if (rigid.corrected_groups > 0) {
    w.op.apply(w.move, w.cg.product);
    for_each_number(w.rhs.size(),
                    [&](std::size_t k) { w.cg.residual[k] = w.rhs[k] - w.cg.product[k]; });
  }
  return Status::fine();
}

StepResult advance(World& world, Workspace& w, double limit) {
  if (!w.holds && count_asleep(world.state) > 0) return advance_awake(world, w, limit);
  State& s = world.state;
  const Numerics& n = world.params.numerics;
  StepResult result;
  double wanted = s.clock.step > 0 ? std::min(s.clock.step, n.max_step) : n.max_step;
  int cg_iterations = 0, solves = 0;
  for (;;) {
    const double step = std::min(wanted, limit);
    const Attempt attempt =
        attempt_step(world, step, result.rejections == 0, w);  // 1 life, 2 contact, 3 solve
    cg_iterations += attempt.cg_iterations;
    solves += attempt.solves;
    Verdict verdict;  // 4 judge
    if (attempt.status.ok) {
      const auto scope = w.timings.scope("judge");
      verdict = judge_step(world, step, w);
      if (attempt.error >= 0) verdict.error = attempt.error;
    } else {
      verdict.good = false;
      verdict.cause = attempt.status.cause;
    }
    if (verdict.good && n.adaptive && verdict.error > 4 * n.tolerance && step > n.min_step) {
      verdict.good = false;
      verdict.cause = "the estimated error is too large";
    }
    const std::int64_t number = s.clock.accepted + s.clock.rejected + result.rejections + 1;
    if (verdict.good && w.reject_every > 0 && number % w.reject_every == 0 &&
        step > 2 * n.min_step) {
      verdict.good = false;
      verdict.cause = "rejected on request";
    }
    if (verdict.good) {
      const Balance b = measure_balance(world, w);
      s.balance.momentum = std::max(s.balance.momentum, b.momentum);
      s.balance.torque = std::max(s.balance.torque, b.torque);
      s.balance.friction_torque = std::max(s.balance.friction_torque, b.friction_torque);
      place_held(w, w.glides ? std::span<const double>(w.ahead.move) : std::span<const double>());
      commit(world, step, cg_iterations, solves, w);
      s.clock.rejected += result.rejections;
      // A step cut short by an event says little about the next one's length.
      s.clock.step = step < wanted ? wanted : next_step(n, step, verdict.error);
      result.accepted = true;
      result.step = step;
      result.error = verdict.error;
      result.max_move = verdict.max_move;
      return result;
    }
    ++result.rejections;
    result.cause = verdict.cause;
    result.cells = verdict.cells;
    if (step <= n.min_step) return result;
    wanted = std::max(0.5 * step, n.min_step);
  }
}

}  // namespace acinus::coupling
