#include "coupling/step/step.hpp"

#include "coupling/migration/migration.hpp"
#include "coupling/step/active_set.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/contact_search.hpp"
#include "coupling/step/explicit_euler.hpp"
#include "coupling/step/linearisation.hpp"
#include "coupling/step/newton.hpp"
#include "coupling/step/references.hpp"
#include "coupling/step/solve.hpp"

namespace acinus::coupling {
namespace {

SystemTerms terms_of(Integrator integrator) {
  const bool implicit = integrator != Integrator::kExplicitEuler;
  return {.stiffness = implicit, .end_values = implicit};
}

Status solve(const World& world, double step, Workspace& w, Effort& effort) {
  const Numerics& n = world.params.numerics;
  Status status = solve_step(world, step, w, effort);
  if (!status.ok) return status;
  if (n.integrator == Integrator::kExplicitEuler) return check_stability(world, step, w);
  // Without step-size control there is no active set, for measurements of the order.
  if (n.adaptive) status = settle_active_set(world, w, effort);
  if (!status.ok || n.integrator == Integrator::kLinearlyImplicit) return status;
  const Assembler assemble_at = [](const World& in, const State& at, double h, Workspace& work,
                                   const SystemTerms& terms) { assemble(in, at, h, work, terms); };
  return iterate_newton(world, step, assemble_at, w, effort);
}

}  // namespace

void assemble(const World& world, const State& at, double step, Workspace& w,
              const SystemTerms& terms) {
  const double end = world.state.clock.time + (terms.end_values ? step : 0);
  refresh_references(world, at, end, w);
  apply_constraints(w);
  refresh_contacts(world, at, end, w);
  refresh_migration(world, at, step, w);
  add_loads(world, at, step, terms, w);
}

void assemble(const World& world, double step, Workspace& w, const SystemTerms& terms) {
  assemble(world, world.state, step, w, terms);
}

Assessment attempt_step(const World& world, double step, bool first_try, Workspace& w,
                        Effort& effort) {
  const State& at = choose_linearisation_point(world, step, first_try, w);
  assemble(world, at, step, w, terms_of(world.params.numerics.integrator));
  const Status solved = solve(world, step, w, effort);
  return assess_step(world, step, 1, solved, w);
}

std::string name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return "explicit-euler";
    case Integrator::kNewton:
      return "newton";
    case Integrator::kLinearlyImplicit:
      break;
  }
  return "linearly-implicit";
}

}  // namespace acinus::coupling
