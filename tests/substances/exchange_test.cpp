/// Exchange of bodies with the medium: uptake against closed forms, and the balance of amounts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.hpp"
#include "substances/diffusion.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

/// Steady concentration around and in a ball that takes up k c, 1 far away.
/// Inside A sinh(p r / R) / r, outside 1 - B / r, with p = R sqrt(k / D) (Thiele modulus).
struct Ball {
  double radius, thiele;
  double operator()(const Vec3& x) const {
    const double r = x.norm(), p = thiele;
    const double inside = radius / (p * std::cosh(p));  // A from continuity of value and flux
    if (r < radius) return r < 1e-9 ? inside * p / radius : inside * std::sinh(p * r / radius) / r;
    return 1 - radius * (1 - std::tanh(p) / p) / r;
  }
};

/// Root mean square error of the field in and near a ball whose far field is held beyond 1.6 R.
double ball_error(double thiele, int n) {
  const Ball exact{50, thiele};
  const double half = 100;
  const VoxelGrid g =
      make_grid({Vec3::Constant(-half), Vec3::Constant(half)}, 2 * half / n * (1 + 1e-12));
  Medium m;
  m.diffusion = 10;
  constexpr double kHold = 1e6;  // 1/s
  m.gain.assign(g.n_voxel(), 0.0);
  m.loss.assign(g.n_voxel(), 0.0);
  std::size_t v = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i, ++v)
        if (const Vec3 x = g.center(i, j, k); x.norm() > 1.6 * exact.radius) {
          m.loss[v] = kHold;
          m.gain[v] = kHold * exact(x);
        }
  Shares shares;
  shares.add(share_sphere(g, Vec3::Zero(), exact.radius));
  Exchange e;
  e.uptake = m.diffusion * thiele * thiele / exact.radius / exact.radius;
  std::vector<double> c(g.n_voxel(), 0.0);
  run(g, m, {shares, {&e, 1}}, {kSteady, 0, kTight}, c);
  return mean_error(g, c, exact, [&](const Vec3& x) { return x.norm() < 1.5 * exact.radius; });
}

TEST(Exchange, BallWithUptakeFollowsItsThieleModulus) {
  for (const double thiele : {0.5, 2.0, 4.0}) {
    const double coarse = ball_error(thiele, 32), fine = ball_error(thiele, 64);
    std::printf("Thiele modulus %.1f: errors %.2e, %.2e: order %.2f\n", thiele, coarse, fine,
                std::log2(coarse / fine));
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.35);
  }
}

/// One voxel without diffusion, filled to a half by a body.
struct OneVoxel {
  VoxelGrid grid = make_grid({Vec3::Zero(), Vec3::Constant(10)}, 10);
  Medium medium;
  Shares shares;
  OneVoxel() { shares.add(std::vector<VoxelShare>{{0, 500}}); }
  double after(const Exchange& e, double start, double step) const {
    std::vector<double> c{start};
    run(grid, medium, {shares, {&e, 1}}, {step, 0, kTight}, c);
    return c[0];
  }
};

TEST(Exchange, MichaelisMentenUptakeIsThatOfTheEndOfTheStep) {
  // c + s V c / (K + c) = c0 has the positive root of c^2 + (K + s V - c0) c - K c0 = 0.
  const OneVoxel voxel;
  Exchange e;
  e.uptake_max = 0.3;
  e.half_max = 1.5;
  for (const double start : {40.0, 2.0, 1e-3})
    for (const double step : {1.0, 60.0, 600.0}) {
      const double b = e.half_max + 0.5 * e.uptake_max * step - start, q = e.half_max * start;
      const double root = std::sqrt(b * b + 4 * q);
      const double exact = b > 0 ? 2 * q / (b + root) : 0.5 * (root - b);
      EXPECT_NEAR(voxel.after(e, start, step), exact, 1e-9 * start) << start << " " << step;
    }
}

TEST(Exchange, SecretionStopsAtSaturation) {
  const OneVoxel voxel;
  Exchange e;
  e.secretion = 0.2;
  EXPECT_NEAR(voxel.after(e, 1, 10), 1 + 0.5 * 0.2 * 10, 1e-12);
  e.saturation = 7;
  EXPECT_NEAR(voxel.after(e, 1, 1e9), 7, 1e-6);
}

TEST(Exchange, SupplyScalesFacesAndSources) {
  const VoxelGrid g = cube(40, 4);
  Medium m;
  m.diffusion = 100;
  m.face.fill({FaceKind::kFixed, 10, 0});
  m.gain.assign(g.n_voxel(), 0.1);
  m.loss.assign(g.n_voxel(), 0.01);
  std::vector<double> whole(g.n_voxel(), 0.0), half = whole;
  run(g, m, no_bodies(), {.step = 60, .tolerance = kTight}, whole);
  run(g, m, no_bodies(), {.step = 60, .tolerance = kTight, .supply = 0.5}, half);
  for (std::size_t v = 0; v < whole.size(); ++v) EXPECT_NEAR(half[v], 0.5 * whole[v], 1e-10);
}

TEST(Exchange, AmountsBalanceAndBodiesAddUp) {
  const VoxelGrid g = cube(100, 12);
  Medium m;
  m.diffusion = 100;
  m.decay = 1e-4;
  m.face.fill({FaceKind::kFixed, 10, 0});
  Shares shares;
  for (const double x : {30.0, 45.0, 70.0}) shares.add(share_sphere(g, Vec3(x, 50, 40), 12));
  std::vector<Exchange> e(3);
  e[0].uptake_max = 0.5;
  e[0].half_max = 2;
  e[2].secretion = 0.1;
  e[2].uptake = 0.03;
  std::vector<double> c(g.n_voxel(), 10.0), gained(3, 0.0);
  const Budget b = run(g, m, {shares, e}, {300, 60, 1e-6}, c, gained);
  const double sum = b.secreted + b.entered - b.decayed;
  const double size = std::abs(b.secreted) + std::abs(b.entered) + b.decayed + total_amount(g, c);
  EXPECT_LT(std::abs(b.change - sum), 1e-12 * size);
  EXPECT_NEAR(gained[0] + gained[2], b.secreted, 1e-12 * size);
  EXPECT_LT(gained[0], 0);
  EXPECT_EQ(gained[1], 0);
  EXPECT_GT(std::ranges::min(c), 0);
}

}  // namespace
}  // namespace acinus::substances
