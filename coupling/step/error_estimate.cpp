#include "coupling/step/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel/threads.hpp"
#include "coupling/migration/migration.hpp"
#include "coupling/step/cell_sums.hpp"

namespace acinus::coupling {

PointErrors::PointErrors(const World& world, double step, Workspace& w)
    : noise_(has_random_force(world)) {
  const State& s = world.state;
  auto& change = w.cg.product;
  set_size(change, w.move.size());
  for_each_own_number(w.system, [&](std::size_t k) { change[k] = 0.5 * w.move[k]; });
  if (has_last_move(s)) {  // else the step is compared with rest
    const double ratio = step / s.clock.last_step;
    for_each_own_number(w.system,
                        [&](std::size_t k) { change[k] -= 0.5 * ratio * s.last_move[k]; });
  }
  change_ = change;
}

double estimate_error(const World& world, double step, Workspace& w) {
  const PointErrors errors(world, step, w);
  const CellSums<2> p =
      sum_over_cells<2>(w, true, [&](std::size_t, Address first, int n_point, CellSums<2>& part) {
        errors.for_each(first, n_point, [&](const Vec3& error) {
          const double e2 = error.squaredNorm();
          part.number[0] += e2;
          part.largest = std::max(part.largest, e2);
        });
        part.number[1] += n_point;
      });
  const auto [sum2, n] = p.number;
  return n > 0 ? std::max(std::sqrt(sum2 / n), std::sqrt(p.largest) / kMostOverMean) : 0;
}

}  // namespace acinus::coupling
