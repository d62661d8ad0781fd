#include "coupling/step/linearly_implicit.hpp"

#include <algorithm>

#include "core/numbers/time_grid.hpp"
#include "core/parallel/arrays.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/step/closing.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/solve.hpp"
#include "coupling/step/stages.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Changes of the set of closed contacts within a step.
constexpr int kMaxActiveSets = 6;

/// Whether the last step's velocity says where the next one leads, and a better step is worth an
/// assembly: spheres come out the same without.
bool is_steady(const World& world) {
  const State& s = world.state;
  if (!has_last_move(s) || s.dcm.n_lane() == 0) return false;
  // Where spheres leave room, deformable cells under pressure bulge into it. What holds a bulge,
  // pressure and stretched triangles, is not all in the matrix: steps that look ahead swing there
  // where plain ones settle (docs/decisions/0035.md).
  if (s.cbm.n_cell() > 0 && s.clock.step < world.params.numerics.max_step) return false;
  const Motility& m = world.params.motility;
  if (!m.random || !controls_at(s.clock, world.params.start_up).motility) return true;
  const double now = s.clock.time - s.clock.origin;
  return !crosses_grid(now - s.clock.last_step, now, m.grid);
}

/// Moves with the velocity of the last step: of constrained cells, and of all others if wanted. The
/// velocity of the others may end, so it is not stretched over a longer step.
void extrapolate_moves(const World& world, double step, bool all, const Workspace& w,
                       std::vector<double>& move) {
  const State& s = world.state;
  const double ratio = step / s.clock.last_step;
  const double others = all ? std::min(1.0, ratio) : 0.0;
  const double constrained = w.constraint.prescribed_velocity ? ratio : 0.0;
  set_size(move, s.last_move.size());
  for_each_number(move.size(), [&](std::size_t k) { move[k] = others * s.last_move[k]; });
  if (!w.constraint.applies()) return;
  for_each_cell(s, [&](const Cell& c) {
    if (!w.constraint.holds(c.index)) return;
    for_each_point(s, c, [&](Address a) {
      store_point(move.data(), a, constrained * load_point(s.last_move.data(), a));
    });
  });
}

/// Finds contacts and assembles where the last step's velocity leads all cells; or, if only
/// constrained cells are extrapolated, where all are now: F and K belong to shapes that fit
/// together.
void assemble_ahead(World& world, double step, bool all, Workspace& w) {
  State& s = world.state;
  LinearisationPoint& point = w.linearisation;
  for (auto* v : {&point.friction, &point.pair_friction, &point.product})
    set_size(*v, w.move.size());
  extrapolate_moves(world, step, all, w, point.move);
  copy_numbers(s.dcm.position, point.dcm_position);
  copy_numbers(s.cbm.position, point.cbm_position);
  const TreeState tree = s.tree;
  if (all) move_points(s, point.move);
  find_all_contacts(world, step, w);
  assemble(world, step, w);
  set_size(w.cg.product, w.move.size());
  if (all) {
    w.op.apply_friction(point.move, point.friction);
    w.op.apply_external_friction(point.move, w.cg.product);
  } else {
    w.op.apply(point.move, point.friction);
    w.op.apply_external(point.move, w.cg.product);
  }
  for_each_own_number(w.system, [&](std::size_t k) {
    point.pair_friction[k] = point.friction[k] - w.cg.product[k];
  });
  remove_constraint(w, point.move, point.friction);
  copy_numbers(point.dcm_position, s.dcm.position);
  copy_numbers(point.cbm_position, s.cbm.position);
  s.tree = tree;
}

}  // namespace

Attempt try_linearly_implicit(World& world, double step, bool extrapolate, Workspace& w) {
  Attempt a;
  const bool all = extrapolate && is_steady(world);
  if (all || (w.constraint.prescribed_velocity && has_last_move(world.state))) {
    assemble_ahead(world, step, all, w);
  } else {
    w.linearisation.move.clear();
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

}  // namespace acinus::coupling
