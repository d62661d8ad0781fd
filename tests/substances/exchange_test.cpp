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

/// Root mean square error in a slab of cells between two faces that hold 1: cosh(p x / L) /
/// cosh(p).
double slab_error(double thiele, int n) {
  constexpr double kHalf = 50;  // L
  const VoxelGrid g = make_grid({Vec3(-kHalf, 0, 0), Vec3(kHalf, 30, 30)}, 2 * kHalf / n + 1e-9);
  Medium m;
  m.diffusion = 10;
  m.face[0] = m.face[1] = {FaceKind::kFixed, 1, 0};
  Exchange e;
  e.uptake = m.diffusion * thiele * thiele / kHalf / kHalf;
  const BoxMesh box = box_mesh(g.low, g.high());
  Shares shares;
  shares.add(share_surface(g, box.node, box.triangle));
  std::vector<double> c(g.n_voxel(), 0.0);
  run(g, m, {shares, {&e, 1}}, {kSteady, 0, kTight}, c);
  const auto exact = [=](const Vec3& x) {
    return std::cosh(thiele * x.x() / kHalf) / std::cosh(thiele);
  };
  return mean_error(g, c, exact, [](const Vec3&) { return true; });
}

TEST(Exchange, SlabWithUptakeFollowsItsThieleModulus) {
  for (const double thiele : {0.5, 2.0, 4.0}) {
    const double coarse = slab_error(thiele, 40), fine = slab_error(thiele, 80);
    std::printf("slab, Thiele modulus %.1f: errors %.2e, %.2e: order %.2f\n", thiele, coarse, fine,
                std::log2(coarse / fine));
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
  }
}

/// A spheroid of cells that consume oxygen at a constant rate as long as there is any. Theory: in
/// the rim c = q (r^2 + 2 a^3 / r - 3 a^2) / (6 D), zero with its slope at the radius a of the
/// core; outside c falls as 1 / r.
TEST(Exchange, SpheroidHasItsViableRim) {
  constexpr double kCellRadius = 12, kSpacing = 22, kDiffusion = 2000, kRate = 20, kSurface = 38;
  constexpr double kReach = 290;
  Shares shares;
  const VoxelGrid g = make_grid({Vec3::Constant(-450), Vec3::Constant(450)}, 10);
  int n = 0;
  constexpr int kMost = static_cast<int>(kReach / kSpacing);
  for (int k = -kMost; k <= kMost; ++k)
    for (int j = -kMost; j <= kMost; ++j)
      for (int i = -kMost; i <= kMost; ++i)
        if (const Vec3 x = kSpacing * Vec3(i, j, k); x.norm() <= kReach) {
          shares.add(share_sphere(g, x, kCellRadius));
          ++n;
        }
  const double cell = kSpacing * kSpacing * kSpacing,
               radius = std::cbrt(3 * n * cell / (4 * kPi)),  // of the spheroid
      rate = kRate * sphere_volume(kCellRadius) / cell;       // q, mean over the tissue
  const auto surface = [&](double a) {  // concentration at the surface with a core of radius a
    return rate * (radius * radius + 2 * a * a * a / radius - 3 * a * a) / (6 * kDiffusion);
  };
  double core = 0, beyond = radius;
  while (beyond - core > 1e-6) {
    const double middle = 0.5 * (core + beyond);
    (surface(middle) > kSurface ? core : beyond) = middle;
  }
  const double outflow = rate * (std::pow(radius, 3) - std::pow(core, 3)) / (3 * kDiffusion);
  Medium m;
  m.diffusion = kDiffusion;
  constexpr double kHold = 1e6;  // 1/s
  m.gain.assign(g.n_voxel(), 0.0);
  m.loss.assign(g.n_voxel(), 0.0);
  std::size_t v = 0;
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      for (int i = 0; i < g.n[0]; ++i, ++v)
        if (const double r = g.center(i, j, k).norm(); r > 1.4 * radius) {
          m.loss[v] = kHold;
          m.gain[v] = kHold * (kSurface + outflow * (1 / radius - 1 / r));
        }
  Exchange e;
  e.uptake_max = kRate;
  e.half_max = 0.1;
  const std::vector<Exchange> exchange(shares.n_body(), e);
  std::vector<double> c(g.n_voxel(), kSurface), gained(shares.n_body(), 0.0);
  EXPECT_TRUE(run(g, m, {shares, exchange}, {1e6, 0, 1e-8}, c, gained).converged);
  int viable = 0;
  for (std::size_t b = 0; b < shares.n_body(); ++b)
    if (mean_over(shares.of(b), c) > e.half_max) ++viable;
  const double found = std::cbrt(std::pow(radius, 3) - 3 * viable * cell / (4 * kPi));
  std::printf("spheroid of %.0f um: rim %.1f um, theory %.1f um (%+.1f %%)\n", radius,
              radius - found, radius - core, 100 * ((radius - found) / (radius - core) - 1));
  EXPECT_GT(core, 0.3 * radius);
  EXPECT_NEAR(radius - found, radius - core, 0.05 * (radius - core));
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
