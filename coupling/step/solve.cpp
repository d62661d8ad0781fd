#include "coupling/step/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel/make_room.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/linearisation.hpp"

namespace acinus::coupling {
namespace {

/// Largest number of retries of a failed solve, each with twice the iterations.
constexpr int kMostDoublings = 5;
constexpr int kMostIterations = std::numeric_limits<int>::max();

/// True if points are held, whose residual has penalty forces.
bool is_constrained(const Workspace& w) {
  return w.constraint.applies() || !w.constraint.anchored_row.empty();
}

solve::CgOptions cg_options(const World& world, const Workspace& w) {
  solve::CgOptions options = world.params.numerics.cg;
  // Cells suspended in liquid are coupled by little but adhesion: a shorter step does not improve
  // the conditioning.
  for (int k = 0; k < std::min(w.failed_solves, kMostDoublings); ++k)
    options.max_iterations +=
        std::min(options.max_iterations, kMostIterations - options.max_iterations);
  return options;
}

solve::CgProblem cg_problem(const World& world, Workspace& w, const Effort& effort) {
  const Clock& clock = world.state.clock;
  // Solves that are repeated in a step take few iterations.
  const int expected = effort.solves == 0 ? static_cast<int>(clock.longest_solve) : 0;
  return {w.op, w.rhs, clock.coarse ? &w.coarse : nullptr, expected};
}

/// Builds the coarse space, if it is enabled, in the vectors of the solve.
void prepare_coarse(const World& world, Workspace& w) {
  if (!world.state.clock.coarse) return;
  w.coarse.prepare(w.op, {w.position, w.active, w.cg.residual, w.cg.product});
}

/// Corrects the rigid motion of every cluster after conjugate gradients.
Status finish_solve(const World& world, const solve::CgResult& result, Workspace& w,
                    Effort& effort) {
  effort.cg_iterations += result.iterations;
  effort.longest_solve = std::max(effort.longest_solve, result.iterations);
  ++effort.solves;
  if (!result.status.ok) return result.status;
  // A rigid error this small relative to a mesh edge is below the tolerance of the solver.
  const solve::RigidResult rigid = solve::correct_rigid_modes(
      w.op, {w.cg.residual, w.cg.product}, w.move, {w.position, w.active},
      world.params.numerics.cg.tolerance, w.rigid);
  if (rigid.corrected_groups > 0) {
    w.op.apply(w.move, w.cg.product);
    for_each_own_number(w.system,
                        [&](std::size_t k) { w.cg.residual[k] = w.rhs[k] - w.cg.product[k]; });
  }
  return Status::fine();
}

/// Solves for w.move from its initial value.
Status solve_move(const World& world, Workspace& w, Effort& effort) {
  const solve::CgResult result =
      solve::solve_cg(cg_problem(world, w, effort), w.move, cg_options(world, w), w.cg);
  return finish_solve(world, result, w, effort);
}

/// The same from a known residual, with a known load.   @pre w.cg.residual, w.cg.load
Status continue_move(const World& world, Workspace& w, Effort& effort) {
  const solve::CgResult result =
      solve::continue_cg(cg_problem(world, w, effort), w.move, cg_options(world, w), w.cg);
  return finish_solve(world, result, w, effort);
}

/// Adds the displacement to the point of linearisation, times `part`, to that of own points.
void add_point_move(double part, Workspace& w) {
  const RowVector<double>& to_point = w.linearisation.move;
  for_each_own_number(w.system, [&](std::size_t k) { w.move[k] += part * to_point[k]; });
}

/// Sets the right-hand side of the displacement from the point of linearisation, A (d - point) = F
/// - Gamma/h point.   @pre w.rhs is F
void subtract_point_friction(Workspace& w) {
  compute_point_friction(w);
  for_each_own_number(w.system, [&](std::size_t k) { w.rhs[k] -= w.cg.product[k]; });
}

/// Norm of A d, to which the tolerance refers, of the displacement d in w.move, of which A (d -
/// point) is in w.rhs and the point is the present value.
double measure_load(Workspace& w) {
  w.op.apply(w.move, w.cg.product);
  for_each_own_number(w.system, [&](std::size_t k) { w.cg.product[k] += w.rhs[k]; });
  return std::sqrt(w.op.precondition(w.cg.product, {}));
}

/// Solves for the displacement from the point of linearisation, in w.move that of the whole step.
/// That of constrained cells is known: their penalty forces would exceed all others.
/// @pre place_constrained for the initial guess
/// @param at_point  the initial guess is the point; else it is the last solution
Status solve_from_point(const World& world, Workspace& w, bool at_point, Effort& effort) {
  prepare_coarse(world, w);
  subtract_point_friction(w);
  if (at_point) w.cg.load = measure_load(w);
  add_point_move(-1, w);
  place_constrained({}, w);
  Status status;
  if (w.cg.load > 0 && std::isfinite(w.cg.load)) {
    if (!at_point) w.op.apply(w.move, w.cg.product);
    set_size(w.cg.residual, w.rhs.size());
    for_each_own_number(w.system, [&](std::size_t k) {
      w.cg.residual[k] = at_point ? w.rhs[k] : w.rhs[k] - w.cg.product[k];
    });
    status = continue_move(world, w, effort);
  } else {
    status = solve_move(world, w, effort);
  }
  add_point_move(1, w);
  place_constrained(w.linearisation.move, w);
  w.op.fetch(w.move);
  return status;
}

/// Solves for the whole displacement from the initial guess in w.move.
/// @param from_point  the guess is the displacement to the point of linearisation
Status solve_from_guess(const World& world, Workspace& w, bool from_point, Effort& effort) {
  for_each_own_number(
      w.system, [&](std::size_t k) { w.rhs[k] = w.system.force[k] + w.system.external_force[k]; });
  if (!w.linearisation.is_elsewhere()) return solve_system(world, w, effort);
  const auto scope = w.timings.scope("solve");
  return solve_from_point(world, w, from_point, effort);
}

}  // namespace

Status solve_step(const World& world, double step, Workspace& w, Effort& effort) {
  const State& s = world.state;
  if (w.linearisation.is_elsewhere()) {
    compute_pair_friction(w);
    for_each_own_number(w.system, [&](std::size_t k) { w.move[k] = w.linearisation.move[k]; });
  } else if (has_last_move(s)) {  // the last step's velocity is a good first guess
    const double ratio = step / s.clock.last_step;
    for_each_own_number(w.system, [&](std::size_t k) { w.move[k] = ratio * s.last_move[k]; });
  } else {
    for_each_own_number(w.system, [&](std::size_t k) { w.move[k] = 0; });
  }
  place_constrained({}, w);  // of a guess their ties would make a huge force
  return solve_from_guess(world, w, true, effort);
}

Status solve_again(const World& world, Workspace& w, Effort& effort) {
  if (is_constrained(w) || w.cg.load == 0) {
    place_constrained({}, w);
    return solve_from_guess(world, w, false, effort);
  }
  const auto scope = w.timings.scope("solve");
  const bool elsewhere = w.linearisation.is_elsewhere();
  if (elsewhere) add_point_move(-1, w);
  const Status status = continue_move(world, w, effort);
  if (elsewhere) add_point_move(1, w);
  w.op.fetch(w.move);
  return status;
}

Status solve_system(const World& world, Workspace& w, Effort& effort) {
  const auto scope = w.timings.scope("solve");
  prepare_coarse(world, w);
  const Status status = solve_move(world, w, effort);
  w.op.fetch(w.move);
  return status;
}

}  // namespace acinus::coupling
