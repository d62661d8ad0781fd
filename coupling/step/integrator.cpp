#include "coupling/step/integrator.hpp"

#include "coupling/step/explicit_euler.hpp"
#include "coupling/step/linearly_implicit.hpp"
#include "coupling/step/newton.hpp"

namespace acinus::coupling {

Attempt attempt_step(World& world, double step, bool first_try, Workspace& w) {
  switch (world.params.numerics.integrator) {
    case Integrator::kExplicitEuler:
      return try_explicit_euler(world, step, w);
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
    case Integrator::kNewton:
      return "newton";
    case Integrator::kLinearlyImplicit:
      break;
  }
  return "linearly-implicit";
}

}  // namespace acinus::coupling
