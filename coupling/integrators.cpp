#include "coupling/integrators.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/threads.hpp"
#include "core/time_grid.hpp"
#include "coupling/closing.hpp"
#include "coupling/judge.hpp"
#include "coupling/life/cell.hpp"
#include "coupling/step.hpp"

namespace acinus::coupling {

/// States on the way and what is assembled there; made when a method first asks for it.
struct StageScratch {
  World world;         ///< the step's world with other positions
  Workspace friction;  ///< Gamma at the start of the step
  Workspace trial;     ///< at the trial positions
  std::vector<double> first, product;
};

namespace {

constexpr int kMaxNewton = 40;
constexpr int kMaxHalvings = 6;
/// Changes of the set of closed contacts within a linearly implicit step.
constexpr int kMaxActiveSets = 6;
/// Newton is done when its last correction was below this share of the step's error tolerance.
constexpr double kNewtonShare = 0.1;
/// Closest features make kinks that Newton cannot cross; below this correction, um, it may stop at
/// one.
constexpr double kKink = 2e-3;

StageScratch& stage_scratch(const World& world, Workspace& w) {
  if (!w.stages) {
    w.stages = std::make_shared<StageScratch>();
    w.stages->world = world;
    size_workspace(world, w.stages->friction);
    size_workspace(world, w.stages->trial);
  }
  return *w.stages;
}

/// The trial world: everything as in `world`, all points moved by d.
void move_trial(const World& world, std::span<const double> d, StageScratch& s) {
  s.world.state = world.state;
  move_points(s.world.state, d);
}

/// Whether the last step's velocity says where the next one leads, and a better step is worth an
/// assembly: spheres come out the same without.
bool is_steady(const World& world) {
  const State& s = world.state;
  if (!has_last_move(s) || s.dcm.n_lane() == 0) return false;
  const Motility& m = world.params.motility;
  if (!m.random || !controls_at(s.clock, world.params.start_up).motility) return true;
  const double now = s.clock.time - s.clock.origin;
  return !crosses_grid(now - s.clock.last_step, now, m.grid);
}

/// Moves at the pace of the last step: of what is held, and of all others if wanted. Theirs may end
/// and is not stretched over a longer step.
void look_ahead(const World& world, double step, bool all, const Workspace& w,
                std::vector<double>& move) {
  const State& s = world.state;
  const double pace = step / s.clock.last_step;
  const double others = all ? std::min(1.0, pace) : 0.0, held = w.glides ? pace : 0.0;
  move.resize(s.last_move.size());
  for_each_number(move.size(), [&](std::size_t k) { move[k] = others * s.last_move[k]; });
  if (!w.holds) return;
  for_each_cell(s, [&](const Cell& c) {
    if (s.asleep[c.index] == 0) return;
    for_each_point(s, c, [&](Address a) {
      store_point(move.data(), a, held * load_point(s.last_move.data(), a));
    });
  });
}

/// Finds contacts and assembles where the last step's velocity leads all; or, if only what is held
/// goes ahead, where all are now: F and K belong to shapes that fit together.
void assemble_ahead(World& world, double step, bool all, Workspace& w) {
  State& s = world.state;
  Ahead& ahead = w.ahead;
  for (auto* v : {&ahead.friction, &ahead.pair_friction, &ahead.product}) v->resize(w.move.size());
  look_ahead(world, step, all, w, ahead.move);
  const std::vector<double> dcm = s.dcm.position, cbm = s.cbm.position;
  if (all) move_points(s, ahead.move);
  find_all_contacts(world, step, w);
  assemble(world, step, w);
  w.cg.product.resize(w.move.size());
  if (all) {
    w.op.apply_friction(ahead.move, ahead.friction);
    w.op.apply_external_friction(ahead.move, w.cg.product);
  } else {
    w.op.apply(ahead.move, ahead.friction);
    w.op.apply_external(ahead.move, w.cg.product);
  }
  for_each_number(w.move.size(), [&](std::size_t k) {
    ahead.pair_friction[k] = ahead.friction[k] - w.cg.product[k];
  });
  leave_out_holds(w, ahead.move, ahead.friction);
  s.dcm.position = dcm;
  s.cbm.position = cbm;
}

Attempt try_linearly_implicit(World& world, double step, bool extrapolate, Workspace& w) {
  Attempt a;
  const bool ahead = extrapolate && is_steady(world);
  if (ahead || (w.glides && has_last_move(world.state))) {
    assemble_ahead(world, step, ahead, w);
  } else {
    w.ahead = {};
    find_all_contacts(world, step, w);
    assemble(world, step, w);
  }
  a.status = solve_step(world, step, w, a.cg_iterations);
  a.solves = 1;
  // Without step-size control steps are as they come, for tables of their order.
  if (!world.params.numerics.adaptive) return a;
  int change = 0;
  while (a.status.ok && change < kMaxActiveSets && activate_closing(w)) {
    a.status = solve_again(world, w, a.cg_iterations);
    ++a.solves;
    ++change;
  }
  if (a.status.ok && change == kMaxActiveSets && pulls_open(w))
    a.status = Status::failed("which contacts close within the step does not settle");
  return a;
}

/// Whether the shapes of the cells swing back and forth without dying down, as explicit Euler makes
/// them beyond its limit: the fastest mode then turns round at every step and outweighs all others.
bool shapes_swing(const World& world, double step, const Workspace& w) {
  const State& s = world.state;
  if (!has_last_move(s)) return false;
  double product = 0, now2 = 0, before2 = 0;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (!s.dcm.active(lane)) continue;
    const int n = s.dcm.group[lane / kLanes].topology->n_node;
    auto velocity = [&](const std::vector<double>& move, double h, int i) -> Vec3 {
      return load_point(move.data(), dcm::node_address(s.dcm, lane, i)) / h;
    };
    Vec3 mean_now = Vec3::Zero(), mean_before = Vec3::Zero();
    for (int i = 0; i < n; ++i) {
      mean_now += velocity(w.move, step, i) / n;
      mean_before += velocity(s.last_move, s.clock.last_step, i) / n;
    }
    for (int i = 0; i < n; ++i) {
      const Vec3 now = velocity(w.move, step, i) - mean_now;
      const Vec3 before = velocity(s.last_move, s.clock.last_step, i) - mean_before;
      product += now.dot(before);
      now2 += now.squaredNorm();
      before2 += before.squaredNorm();
    }
  }
  constexpr double kOpposite = -0.7, kNotLess = 0.9;
  return product < kOpposite * std::sqrt(now2 * before2) && now2 > kNotLess * kNotLess * before2;
}

Attempt try_explicit_euler(const World& world, double step, Workspace& w) {
  Attempt a;
  find_all_contacts(world, 0, w);
  assemble(world, step, w, {.stiffness_scale = 0});
  a.status = solve_step(world, step, w, a.cg_iterations);
  a.solves = 1;
  if (a.status.ok && shapes_swing(world, step, w))
    a.status = Status::failed(
        "explicit Euler is unstable at this step: the cells' shapes swing back and forth. Set "
        "time.step to half, or time.integrator to linearly-implicit");
  return a;
}

Attempt try_ros2(const World& world, double step, Workspace& w) {
  const double gamma = 1 - 1 / std::sqrt(2.0);
  Attempt a;
  StageScratch& s = stage_scratch(world, w);
  find_all_contacts(world, 0, w);
  assemble(world, step, w, {.friction_factor = 1 / gamma});
  a.status = solve_step(world, step * gamma, w, a.cg_iterations);
  if (!a.status.ok) return a;
  s.first = w.move;
  for (double& k1 : s.first) k1 /= gamma;

  find_all_contacts(world, 0, s.friction);
  assemble(world, step, s.friction, {.stiffness_scale = 0});
  move_trial(world, s.first, s);
  find_all_contacts(s.world, step, s.trial);
  assemble(s.world, step, s.trial, {.stiffness_scale = 0});
  s.product.resize(s.first.size());
  for (std::size_t k = 0; k < w.rhs.size(); ++k)
    w.rhs[k] = s.trial.system.force[k] + s.trial.system.external_force[k];
  for (Workspace* at : {&s.friction, &s.trial}) {
    at->op.apply(s.first, s.product);
    for (std::size_t k = 0; k < w.rhs.size(); ++k) w.rhs[k] -= s.product[k];
  }
  for (std::size_t k = 0; k < w.move.size(); ++k) w.move[k] = -gamma * s.first[k];
  a.status = solve_system(world, w, a.cg_iterations);
  a.solves = 2;
  if (!a.status.ok) return a;
  for (std::size_t k = 0; k < w.move.size(); ++k) {
    const double k1 = s.first[k], k2 = w.move[k] / gamma;
    w.move[k] = 1.5 * k1 + 0.5 * k2;
    s.product[k] = 0.5 * (k1 + k2);
  }
  a.error = error_norm(world, w, s.product);
  return a;
}

/// Residual of backward Euler at the trial positions, F(x + d) - Gamma/h d, into trial.rhs; returns
/// its size in the norm of the preconditioner.
double newton_residual(const World& world, double step, std::span<const double> d,
                       StageScratch& s) {
  move_trial(world, d, s);
  find_all_contacts(s.world, step, s.trial);
  assemble(s.world, step, s.trial);
  s.product.resize(d.size());
  s.friction.op.apply(d, s.product);
  for (std::size_t k = 0; k < d.size(); ++k)
    s.trial.rhs[k] = s.trial.system.force[k] + s.trial.system.external_force[k] - s.product[k];
  return std::sqrt(s.trial.op.precondition(s.trial.rhs, {}));
}

double largest_move(const Workspace& w, std::span<const double> field) {
  double largest = 0;
  for (std::size_t b = 0; b < w.system.block.size(); ++b)
    for (int i = 0; i < w.system.block[b].pattern->n_point; ++i)
      for (int l = 0; l < kLanes; ++l)
        if (w.active[b * kLanes + static_cast<std::size_t>(l)])
          largest = std::max(
              largest,
              load_point(field.data(),
                         make_address(w.system.block[b].first_row + static_cast<std::size_t>(i), l))
                  .norm());
  return largest;
}

Attempt try_newton(World& world, double step, Workspace& w) {
  // The first iteration is a linearly implicit step; it also leaves what the judge looks at.
  Attempt a = try_linearly_implicit(world, step, false, w);
  if (!a.status.ok) return a;
  StageScratch& s = stage_scratch(world, w);
  find_all_contacts(world, step, s.friction);
  assemble(world, step, s.friction, {.stiffness_scale = 0});
  const double done = kNewtonShare * world.params.numerics.tolerance;
  double size = newton_residual(world, step, w.move, s);
  for (int iteration = 0; iteration < kMaxNewton; ++iteration) {
    std::ranges::fill(s.trial.move, 0.0);
    a.status = solve_system(s.world, s.trial, a.cg_iterations);
    ++a.solves;
    if (!a.status.ok) return a;
    s.first = s.trial.move;
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

}  // namespace

Attempt attempt_step(World& world, double step, bool first_try, Workspace& w) {
  switch (world.params.numerics.integrator) {
    case Integrator::kExplicitEuler:
      return try_explicit_euler(world, step, w);
    case Integrator::kRos2:
      return try_ros2(world, step, w);
    case Integrator::kNewton:
      return try_newton(world, step, w);
    case Integrator::kLinearlyImplicit:
      break;
  }
  return try_linearly_implicit(world, step, first_try && world.params.numerics.extrapolate, w);
}

std::string name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return "explicit-euler";
    case Integrator::kRos2:
      return "ros2";
    case Integrator::kNewton:
      return "newton";
    case Integrator::kLinearlyImplicit:
      break;
  }
  return "linearly-implicit";
}

}  // namespace acinus::coupling
