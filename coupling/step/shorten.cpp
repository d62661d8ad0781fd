#include "coupling/step/shorten.hpp"

#include "core/numbers/time_grid.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/migration/migration.hpp"

namespace acinus::coupling {
namespace {

/// Largest number of assessments of one displacement: several cells may limit it.
constexpr int kMostTries = 4;

/// True if the random force changes within a step.
bool has_noise(const World& world, double step) {
  if (!has_random_force(world)) return false;
  const double now = world.state.clock.time - world.state.clock.origin;
  constexpr double kWithin = 1 - 1e-6;  // a step may end where the force changes
  return crosses_grid(now, now + kWithin * step, world.params.motility.grid);
}

bool can_shorten(const World& world, double step, const Workspace& w) {
  const Numerics& n = world.params.numerics;
  return n.adaptive && n.integrator == Integrator::kLinearlyImplicit &&
         !w.constraint.prescribed_velocity && !has_noise(world, step);
}

}  // namespace

double shorten_step(const World& world, double step, Workspace& w, Assessment& a) {
  if (a.accepted || a.usable == 0 || !can_shorten(world, step, w)) return 1;
  double part = 1;
  for (int k = 0; k < kMostTries && !a.accepted; ++k) {
    const double factor = a.usable;
    part *= factor;
    if (part < kLeastPart) {
      a.usable = part;
      return 1;
    }
    for_each_own_number(w.system, [&](std::size_t i) { w.move[i] *= factor; });
    w.op.fetch(w.move);
    a = assess_step(world, step * part, part, {}, w);
  }
  return a.accepted ? part : 1;
}

}  // namespace acinus::coupling
