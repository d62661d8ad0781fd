#include "coupling/step/solve.hpp"

#include <algorithm>
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

solve::CgProblem cg_problem(const World& world, Workspace& w, const Effort& effort,
                            std::span<const double> product = {}) {
  const Clock& clock = world.state.clock;
  // Solves that are repeated in a step take few iterations.
  const int expected = effort.solves == 0 ? static_cast<int>(clock.longest_solve) : 0;
  return {w.op, w.rhs, clock.coarse ? &w.coarse : nullptr, product, expected};
}

/// Corrects the rigid motion of every cluster after conjugate gradients, and fetches ghost points.
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
  w.op.fetch(w.move);
  return Status::fine();
}

/// Solves for the whole displacement from the initial guess in w.move.
/// @param from_point  the guess is the displacement to the point of linearisation
Status solve_from_guess(const World& world, Workspace& w, bool from_point, Effort& effort) {
  for_each_own_number(
      w.system, [&](std::size_t k) { w.rhs[k] = w.system.force[k] + w.system.external_force[k]; });
  LinearisationPoint& point = w.linearisation;
  if (!point.is_elsewhere()) return solve_system(world, w, effort);
  // A (d - point) = F - Gamma/h point, solved for d: the tolerance refers to the whole
  // displacement. That of constrained cells is known: their penalty forces would exceed all others.
  RowVector<double>& to_point = w.rigid.mode;
  set_size(to_point, w.move.size());
  for_each_own_number(w.system, [&](std::size_t k) { to_point[k] = point.move[k]; });
  std::swap(to_point, w.move);
  place_constrained({}, w);
  w.op.apply(w.move, point.product);
  std::swap(to_point, w.move);
  place_constrained({}, w);
  for_each_own_number(w.system,
                      [&](std::size_t k) { w.rhs[k] += point.product[k] - point.friction[k]; });
  const bool is_known = from_point && !is_constrained(w);
  const Status status =
      solve_system(world, w, effort,
                   is_known ? std::span<const double>(point.product) : std::span<const double>());
  for_each_own_number(w.system, [&](std::size_t k) { w.rhs[k] -= point.product[k]; });
  place_constrained(point.move, w);
  return status;
}

}  // namespace

Status solve_step(const World& world, double step, Workspace& w, Effort& effort) {
  const State& s = world.state;
  if (w.linearisation.is_elsewhere()) {
    compute_point_products(w);
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
  const RowVector<double>& product = w.linearisation.product;
  // The solution is the whole displacement, not that from the point of linearisation.
  if (elsewhere) for_each_own_number(w.system, [&](std::size_t k) { w.rhs[k] += product[k]; });
  const solve::CgResult result =
      solve::continue_cg(cg_problem(world, w, effort), w.move, cg_options(world, w), w.cg);
  const Status status = finish_solve(world, result, w, effort);
  if (elsewhere) for_each_own_number(w.system, [&](std::size_t k) { w.rhs[k] -= product[k]; });
  return status;
}

Status solve_system(const World& world, Workspace& w, Effort& effort,
                    std::span<const double> product) {
  const auto scope = w.timings.scope("solve");
  if (world.state.clock.coarse)
    w.coarse.prepare(w.op, {w.position, w.active, w.cg.residual, w.cg.product});
  const solve::CgResult result =
      solve::solve_cg(cg_problem(world, w, effort, product), w.move, cg_options(world, w), w.cg);
  return finish_solve(world, result, w, effort);
}

}  // namespace acinus::coupling
