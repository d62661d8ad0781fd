#include "coupling/step/explicit_euler.hpp"

#include <cmath>
#include <span>

namespace acinus::coupling {
namespace {

/// True if cell shapes oscillate without decay: beyond the limit of stability of explicit Euler the
/// fastest mode changes sign in every step and dominates all others.
bool shapes_oscillate(const World& world, double step, const Workspace& w) {
  const State& s = world.state;
  if (!has_last_move(s)) return false;
  double product = 0, now2 = 0, before2 = 0;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (!s.dcm.active(lane)) continue;
    const int n = s.dcm.group[lane / kLanes].n_point();
    auto velocity = [&](std::span<const double> move, double h, int i) -> Vec3 {
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

}  // namespace

Status check_stability(const World& world, double step, Workspace& w) {
  solve::gather_rows(w.system, w.move);
  if (!shapes_oscillate(world, step, w)) return Status::fine();
  return Status::failed(
      "explicit Euler is unstable at this step: the cells' shapes swing back and forth. Set "
      "time.step to half, or time.integrator to linearly-implicit");
}

}  // namespace acinus::coupling
