#include "coupling/step/newton.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/step/linearly_implicit.hpp"
#include "coupling/step/solve.hpp"
#include "coupling/step/stages.hpp"
#include "coupling/step/trial.hpp"

namespace acinus::coupling {
namespace {

constexpr int kMaxNewton = 40;
constexpr int kMaxHalvings = 6;
/// Newton is done when its last correction was below this share of the step's error tolerance.
constexpr double kNewtonShare = 0.1;
/// Closest features make kinks that Newton cannot cross; below this correction, um, it may stop at
/// one.
constexpr double kKink = 2e-3;

/// Residual of backward Euler at the trial positions, F(x + d) - Gamma/h d, into work.rhs of the
/// trial; returns its size in the norm of the preconditioner.
double newton_residual(const World& world, double step, std::span<const double> d, Trial& s) {
  move_trial(world, d, s);
  find_all_contacts(s.world, step, s.work);
  assemble(s.world, step, s.work);
  s.product.resize(d.size());
  s.friction.op.apply(d, s.product);
  for_each_own_number(s.work.system, [&](std::size_t k) {
    s.work.rhs[k] = s.work.system.force[k] + s.work.system.external_force[k] - s.product[k];
  });
  return std::sqrt(s.work.op.precondition(s.work.rhs, {}));
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

}  // namespace

Attempt try_newton(World& world, double step, Workspace& w) {
  // The first iteration is a linearly implicit step; it also leaves what acceptance looks at.
  Attempt a = try_linearly_implicit(world, step, false, w);
  if (!a.status.ok) return a;
  solve::gather_rows(w.system, w.move);
  Trial s;
  begin_trial(world, s);
  find_all_contacts(world, step, s.friction);
  assemble(world, step, s.friction, {.stiffness_scale = 0});
  const double done = kNewtonShare * world.params.numerics.tolerance;
  double size = newton_residual(world, step, w.move, s);
  for (int iteration = 0; iteration < kMaxNewton; ++iteration) {
    std::ranges::fill(s.work.move, 0.0);
    a.status = solve_system(s.world, s.work, a.cg_iterations);
    ++a.solves;
    if (!a.status.ok) return a;
    solve::gather_rows(s.work.system, s.work.move);
    s.first = s.work.move;
    const double largest = largest_move(w, s.first);
    if (largest <= done) return a;
    double share = 1, next = 0;
    std::vector<double> tried(w.move.size());
    for (int halving = 0; halving <= kMaxHalvings; ++halving, share /= 2) {
      for (std::size_t k = 0; k < tried.size(); ++k) tried[k] = w.move[k] + share * s.first[k];
      next = newton_residual(world, step, tried, s);
      if (next < size) break;
    }
    if (!(next < size)) {
      if (largest > kKink) a.status = Status::failed("Newton's method found no way down");
      return a;
    }
    w.move = tried;
    size = next;
  }
  a.status = Status::failed("Newton's method did not converge");
  return a;
}

}  // namespace acinus::coupling
