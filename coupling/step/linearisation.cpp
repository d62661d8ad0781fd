#include "coupling/step/linearisation.hpp"

#include <algorithm>
#include <span>

#include "core/numbers/time_grid.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/migration/migration.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/move_points.hpp"
#include "coupling/step/near_cells.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// True if the velocity of the last step predicts the next displacement and the predictor pays for
/// its assembly. It does not for spheres alone, whose step is the same without it.
bool is_steady(const World& world) {
  const State& s = world.state;
  if (!has_last_move(s) || s.dcm.n_lane() == 0) return false;
  // Forces between triangles depend on curvatures too, of which the matrix has nothing: a steady
  // motion would need three quarters of the stiffness in it, and steps from rest need half.
  if (world.params.dcm_contact.law == dcm::ContactLaw::kMaugisDugdale) return false;
  // Deformable cells under pressure bulge into gaps between spheres. The matrix has only part of
  // the resistance of a bulge, pressure and stretched triangles: extrapolated steps oscillate there
  // and others settle (decision 35).
  if (s.cbm.n_cell() > 0 && s.clock.step < world.params.numerics.max_step) return false;
  if (!has_random_force(world)) return true;
  const double now = s.clock.time - s.clock.origin;
  return !crosses_grid(now - s.clock.last_step, now, world.params.motility.grid);
}

/// Part of the last displacement that extrapolated points make in a step. They are not
/// extrapolated over a longer step than the last, since their motion may end.
double extrapolated_part(const State& s, double step) {
  return std::min(1.0, step / s.clock.last_step);
}

/// Displacements with the velocity of the last step: those of constrained cells, and on request all
/// others. With several processes those of own cells, or of all if some are constrained.
void extrapolate_moves(const World& world, double step, bool all, const Workspace& w,
                       RowVector<double>& move) {
  const State& s = world.state;
  const double ratio = step / s.clock.last_step;
  const double others = all ? extrapolated_part(s, step) : 0.0;
  const double constrained = w.constraint.prescribed_velocity ? ratio : 0.0;
  set_size(move, s.last_move.size());
  const auto extrapolate = [&](std::size_t k) { move[k] = others * s.last_move[k]; };
  if (!w.constraint.applies()) return for_each_own_number(w.system, extrapolate);
  for_each_number(move.size(), extrapolate);
  for_each_cell(s, [&](const Cell& c) {
    if (!w.constraint.holds(c.index)) return;
    for_each_point(s, c, [&](Address a) {
      store_point(move.data(), a, constrained * load_point(s.last_move.data(), a));
    });
  });
}

/// Forces of boundary and medium, nN, at the velocity of the displacement to the point of
/// linearisation, into w.cg.product; with their stiffness if not all cells are displaced.
void apply_external_at_point(Workspace& w) {
  const LinearisationPoint& point = w.linearisation;
  if (point.moves_all)
    w.op.apply_external_friction(point.move, w.cg.product);
  else
    w.op.apply_external(point.move, w.cg.product);
}

}  // namespace

const State& choose_linearisation_point(const World& world, double step, bool first_try,
                                        Workspace& w) {
  const State& s = world.state;
  const Numerics& n = world.params.numerics;
  LinearisationPoint& point = w.linearisation;
  point.move.clear();
  point.moves_all = false;
  if (n.integrator == Integrator::kExplicitEuler) return s;
  point.moves_all = n.integrator == Integrator::kLinearlyImplicit && n.extrapolate && first_try &&
                    is_steady(world);
  if (!point.moves_all && !(w.constraint.prescribed_velocity && has_last_move(s))) return s;
  extrapolate_moves(world, step, point.moves_all, w, point.move);
  // If only constrained cells are extrapolated the system is that of the present positions, so that
  // F and K belong to compatible shapes.
  if (!point.moves_all) return s;
  static_cast<PresentState&>(point.state) = s;
  if (w.constraint.applies() || w.system.ownership.is_whole())
    move_points(point.state, point.move);
  else
    move_present_points(w, point.move, point.state);
  return point.state;
}

void compute_pair_friction(Workspace& w) {
  LinearisationPoint& point = w.linearisation;
  w.op.fetch(point.move);
  for (auto* v : {&point.pair_friction, &w.cg.product}) set_size(*v, w.move.size());
  if (point.moves_all)
    w.op.apply_friction(point.move, point.pair_friction);
  else
    w.op.apply(point.move, point.pair_friction);
  apply_external_at_point(w);
  for_each_own_number(w.system, [&](std::size_t k) { point.pair_friction[k] -= w.cg.product[k]; });
}

void compute_point_friction(Workspace& w) {
  const LinearisationPoint& point = w.linearisation;
  apply_external_at_point(w);
  for_each_own_number(w.system, [&](std::size_t k) { w.cg.product[k] += point.pair_friction[k]; });
  remove_constraint(w, point.move, w.cg.product);
}

}  // namespace acinus::coupling
