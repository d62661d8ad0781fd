#include "coupling/step/newton.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "coupling/step/held_contacts.hpp"
#include "coupling/step/move_points.hpp"
#include "coupling/step/solve.hpp"
#include "coupling/step/workspace_size.hpp"

namespace acinus::coupling {
namespace {

constexpr int kMaxNewton = 40;   ///< iterations
constexpr int kMaxHalvings = 6;  ///< of one correction in the line search
/// Convergence tolerance: last correction over the step's error tolerance.
constexpr double kNewtonShare = 0.1;
/// Correction, um, below which the iteration may stop at a kink: switches of closest features make
/// kinks that Newton cannot cross.
constexpr double kKink = 2e-3;

/// Step of backward Euler to be solved.
struct Equation {
  const World& world;
  double step;  ///< s
  const Assembler& assemble;
};

/// Trial state of the iteration and the system assembled there.
struct Trial {
  State state;
  Workspace friction;  ///< Gamma at the start of the step
  Workspace work;      ///< at the trial state
  std::vector<double> product;
};

/// Computes the residual of backward Euler at the trial positions, F(x + d) - Gamma/h d, into
/// work.rhs of the trial.   @return its norm under the preconditioner
double newton_residual(const Equation& e, std::span<const double> d, Trial& trial) {
  trial.state = e.world.state;
  hand_over_contacts(e.world.ranks, trial.work,
                     trial.state);  // whose cells have owners of their own
  move_points(trial.state, d);
  e.assemble(e.world, trial.state, e.step, trial.work, {});
  trial.product.resize(d.size());
  trial.friction.op.apply(d, trial.product);
  for_each_own_number(trial.work.system, [&](std::size_t k) {
    const solve::System& s = trial.work.system;
    trial.work.rhs[k] = s.force[k] + s.external_force[k] - trial.product[k];
  });
  return std::sqrt(trial.work.op.precondition(trial.work.rhs, {}));
}

double largest_move(const Workspace& w, std::span<const double> field) {
  double largest = 0;
  for (std::size_t b = 0; b < w.system.block.size(); ++b)
    for (int i = 0; i < w.system.block[b].pattern->n_point; ++i)
      for (int l = 0; l < kLanes; ++l)
        if (w.active[b * kLanes + l])
          largest = std::max(
              largest,
              load_point(field.data(), make_address(w.system.block[b].first_row + i, l)).norm());
  return largest;
}

/// Backtracking line search: halves a correction of the displacement until the residual decreases.
/// @param[in,out] move  displacement, corrected
/// @param[in,out] size  norm of the residual
/// @return false if no step along the correction decreases it
bool search_line(const Equation& equation, std::span<const double> correction,
                 RowVector<double>& move, double& size, Trial& trial) {
  RowVector<double> tried(move.size());
  double share = 1;
  for (int halving = 0; halving <= kMaxHalvings; ++halving, share /= 2) {
    for (std::size_t k = 0; k < tried.size(); ++k) tried[k] = move[k] + share * correction[k];
    const double next = newton_residual(equation, tried, trial);
    if (!(next < size)) continue;
    move = tried;
    size = next;
    return true;
  }
  return false;
}

}  // namespace

Status iterate_newton(const World& world, double step, const Assembler& assemble, Workspace& w,
                      Effort& effort) {
  solve::gather_rows(w.system, w.move);
  const Equation equation{world, step, assemble};
  Trial trial;
  trial.friction.constraint = trial.work.constraint = w.constraint;
  size_workspace(world, trial.friction);
  size_workspace(world, trial.work);
  trial.state = world.state;
  hand_over_contacts(world.ranks, trial.friction, trial.state);
  assemble(world, trial.state, step, trial.friction, {.stiffness = false});
  const double done = kNewtonShare * world.params.numerics.tolerance;
  double size = newton_residual(equation, w.move, trial);
  for (int iteration = 0; iteration < kMaxNewton; ++iteration) {
    std::ranges::fill(trial.work.move, 0.0);
    Status status = solve_system(world, trial.work, effort);
    if (!status.ok) return status;
    solve::gather_rows(trial.work.system, trial.work.move);
    const RowVector<double> correction = trial.work.move;
    const double largest = largest_move(w, correction);
    if (largest <= done) return Status::fine();
    if (search_line(equation, correction, w.move, size, trial)) continue;
    if (largest > kKink) return Status::failed("Newton's method found no way down");
    return Status::fine();
  }
  return Status::failed("Newton's method did not converge");
}

}  // namespace acinus::coupling
