#include "coupling/step/ros2.hpp"

#include <cmath>

#include "coupling/step/error_estimate.hpp"
#include "coupling/step/solve.hpp"
#include "coupling/step/stages.hpp"
#include "coupling/step/trial.hpp"

namespace acinus::coupling {

Attempt try_ros2(const World& world, double step, Workspace& w) {
  const double gamma = 1 - 1 / std::sqrt(2.0);
  Attempt a;
  Trial s;
  begin_trial(world, s);
  find_all_contacts(world, 0, w);
  assemble(world, step, w, {.friction_factor = 1 / gamma});
  a.status = solve_step(world, step * gamma, w, a.cg_iterations);
  if (!a.status.ok) return a;
  solve::gather_rows(w.system, w.move);
  s.first = w.move;
  for (double& k1 : s.first) k1 /= gamma;

  find_all_contacts(world, 0, s.friction);
  assemble(world, step, s.friction, {.stiffness_scale = 0});
  move_trial(world, s.first, s);
  find_all_contacts(s.world, step, s.work);
  assemble(s.world, step, s.work, {.stiffness_scale = 0});
  s.product.resize(s.first.size());
  for_each_own_number(w.system, [&](std::size_t k) {
    w.rhs[k] = s.work.system.force[k] + s.work.system.external_force[k];
  });
  for (Workspace* at : {&s.friction, &s.work}) {
    at->op.apply(s.first, s.product);
    for_each_own_number(w.system, [&](std::size_t k) { w.rhs[k] -= s.product[k]; });
  }
  for_each_own_number(w.system, [&](std::size_t k) { w.move[k] = -gamma * s.first[k]; });
  a.status = solve_system(world, w, a.cg_iterations);
  a.solves = 2;
  if (!a.status.ok) return a;
  for_each_own_number(w.system, [&](std::size_t k) {
    const double k1 = s.first[k], k2 = w.move[k] / gamma;
    w.move[k] = 1.5 * k1 + 0.5 * k2;
    s.product[k] = 0.5 * (k1 + k2);
  });
  w.op.fetch(w.move);
  a.error = error_norm(world, w, s.product);
  return a;
}

}  // namespace acinus::coupling
