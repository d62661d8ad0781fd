#include "coupling/step/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/parallel/threads.hpp"
#include "coupling/migration/migration.hpp"
#include "coupling/step/cell_sums.hpp"

namespace acinus::coupling {

namespace {

/// Norm of an error field, um: the larger of its rms and a fifth of its maximum over nodes. With
/// random motility the mean of every cell is left out: it is white noise, integrated exactly.
/// @param field  [n_row][3][lane] um
double error_norm(const World& world, const Workspace& w, std::span<const double> field) {
  const bool noise = has_random_force(world);
  const CellSums<2> p =
      sum_over_cells<2>(w, true, [&](std::size_t, Address first, int n_point, CellSums<2>& part) {
        auto at = [&](int i) {
          return load_point(field.data(), first + static_cast<Address>(i * kPointStride));
        };
        Vec3 mean = Vec3::Zero();
        if (noise) {
          for (int i = 0; i < n_point; ++i) mean += at(i);
          mean /= n_point;
        }
        for (int i = 0; i < n_point; ++i) {
          const double e2 = (at(i) - mean).squaredNorm();
          part.number[0] += e2;
          part.largest = std::max(part.largest, e2);
        }
        part.number[1] += n_point;
      });
  const auto [sum2, n] = p.number;
  return n > 0 ? std::max(std::sqrt(sum2 / n), std::sqrt(p.largest) / 5) : 0;
}

}  // namespace

double estimate_error(const World& world, double step, Workspace& w) {
  const State& s = world.state;
  auto& change = w.cg.product;
  set_size(change, w.move.size());
  for_each_own_number(w.system, [&](std::size_t k) { change[k] = 0.5 * w.move[k]; });
  if (has_last_move(s)) {  // else the step is compared with rest
    const double ratio = step / s.clock.last_step;
    for_each_own_number(w.system,
                        [&](std::size_t k) { change[k] -= 0.5 * ratio * s.last_move[k]; });
  }
  return error_norm(world, w, change);
}

}  // namespace acinus::coupling
