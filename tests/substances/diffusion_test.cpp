/// Diffusion and decay against closed forms, their orders of convergence, and the faces of the box.

#include "substances/diffusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel/threads.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

/// Error of c = 1 + cos(pi x / L) exp(-(D (pi / L)^2 + k) t) after `time`, 1 decaying too.
double mode_error(int n, double step, double time) {
  const double edge = 100, diffusion = 50, decay = 0.002;
  const VoxelGrid g = cube(edge, n);
  Medium m;
  m.diffusion = diffusion;
  m.decay = decay;
  const auto exact = [&](double t) {
    return [=](const Vec3& x) {
      return std::exp(-decay * t) * (1 + std::cos(kPi * x.x() / edge) *
                                             std::exp(-diffusion * kPi * kPi / edge / edge * t));
    };
  };
  std::vector<double> c = sample(g, exact(0));
  run(g, m, no_bodies(), {time, step, kTight}, c);
  return largest_error(g, c, exact(time));
}

TEST(Diffusion, IsOfFirstOrderInTime) {
  // A grid so fine that its own error, 1e-5 of this mode, is small beside that of the step.
  const double coarse = mode_error(64, 4, 60), fine = mode_error(64, 2, 60);
  std::printf("errors %.3e, %.3e: order %.2f\n", coarse, fine, std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1);
}

TEST(Diffusion, IsOfSecondOrderInSpace) {
  // Steady decay from a face of fixed concentration: cosh((L - x) / l) / cosh(L / l).
  const double edge = 100, length = 20;
  const auto error = [&](int n) {
    const VoxelGrid g = cube(edge, n);
    Medium m;
    m.diffusion = 10;
    m.decay = m.diffusion / length / length;
    m.face[0] = {FaceKind::kFixed, 1, 0};
    std::vector<double> c(g.n_voxel(), 0.0);
    run(g, m, no_bodies(), {kSteady, 0, kTight}, c);
    return largest_error(g, c, [&](const Vec3& x) {
      return std::cosh((edge - x.x()) / length) / std::cosh(edge / length);
    });
  };
  const double coarse = error(32), fine = error(64);
  std::printf("decay length: errors %.3e, %.3e: order %.2f\n", coarse, fine,
              std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
  EXPECT_LT(fine, 1e-3);
}

TEST(Diffusion, SpreadsAPointAsAGaussian) {
  // M / (4 pi D t)^(3/2) exp(-r^2 / 4 D t) in a box whose faces it does not reach.
  const double edge = 160, diffusion = 50, time = 4;
  const auto error = [&](int n, double step) {
    const VoxelGrid g = cube(edge, n);
    Medium m;
    m.diffusion = diffusion;
    const Vec3 middle = Vec3::Constant(edge / 2);
    const auto exact = [&](double t) {
      return [=](const Vec3& x) {
        return std::exp(-(x - middle).squaredNorm() / (4 * diffusion * t)) /
               std::pow(4 * kPi * diffusion * t, 1.5);
      };
    };
    std::vector<double> c = sample(g, exact(time / 2));
    run(g, m, no_bodies(), {time / 2, step, kTight}, c);
    return largest_error(g, c, exact(time)) / exact(time)(middle);
  };
  // Steps as h^2: both errors fall together.
  const double coarse = error(32, 0.08), fine = error(64, 0.02);
  std::printf("point source: errors %.3e, %.3e of the largest: ratio %.2f\n", coarse, fine,
              coarse / fine);
  EXPECT_LT(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
}

TEST(Diffusion, StaysPositiveInLongSteps) {
  const VoxelGrid g = cube(100, 20);
  Medium m;
  m.diffusion = 1000;
  std::vector<double> c(g.n_voxel(), 0.0);
  c[g.index(10, 10, 10)] = 1;
  run(g, m, no_bodies(), {600, 0, kTight}, c);
  EXPECT_GT(std::ranges::min(c), 0);
  EXPECT_NEAR(total_amount(g, c), g.voxel_volume(), 1e-12 * g.voxel_volume());
}

TEST(Diffusion, FaceWithACoefficientIsARobinWall) {
  // Flux P (c_out - c(0)) = D (c(0) - 0) / L between a wall and a face held at 0: a straight line.
  const double edge = 80, diffusion = 30, permeability = 0.7, outside = 5;
  const VoxelGrid g = cube(edge, 9);
  Medium m;
  m.diffusion = diffusion;
  m.face[2] = {FaceKind::kExchange, outside, permeability};
  m.face[3] = {FaceKind::kFixed, 0, 0};
  std::vector<double> c(g.n_voxel(), 0.0);
  run(g, m, no_bodies(), {kSteady, 0, kTight}, c);
  const double at_wall = outside * permeability / (permeability + diffusion / edge);
  // A straight line is exact on the grid; what is left of the start is edge^2 / D / step.
  EXPECT_LT(largest_error(g, c, [&](const Vec3& x) { return at_wall * (1 - x.y() / edge); }),
            1e-8 * outside);
}

TEST(Diffusion, BalancesToRoundOffWhateverTheTolerance) {
  const VoxelGrid g = make_grid({Vec3(-3, 2, 7), Vec3(90, 110, 80)}, 7.3);
  Medium m;
  m.diffusion = 20;
  m.decay = 0.01;
  m.face[0] = {FaceKind::kFixed, 3, 0};
  m.face[5] = {FaceKind::kExchange, 1, 0.5};
  m.gain.assign(g.n_voxel(), 0.001);
  m.loss.assign(g.n_voxel(), 0.002);
  std::vector<double> c = sample(g, [](const Vec3& x) { return 1 + std::sin(0.1 * x.x()); });
  for (const double tolerance : {1e-3, 1e-9}) {
    const Budget b = run(g, m, no_bodies(), {120, 50, tolerance}, c);
    const double sum = b.secreted + b.entered + b.supplied - b.decayed;
    const double size = std::abs(b.entered) + std::abs(b.supplied) + b.decayed + total_amount(g, c);
    std::printf("tolerance %.0e: imbalance %.2e\n", tolerance, std::abs(b.change - sum) / size);
    EXPECT_EQ(b.substeps, 3);
    EXPECT_LT(std::abs(b.change - sum), 1e-12 * size);
  }
}

TEST(Diffusion, HasTheSameBitsWithMoreThreads) {
  const VoxelGrid g = cube(300, 37);  // more voxels than threads are worth
  Medium m;
  m.diffusion = 200;
  m.decay = 0.001;
  m.face.fill({FaceKind::kFixed, 2, 0});
  const auto result = [&](int n) {
    set_threads(n);
    std::vector<double> c = sample(g, [](const Vec3& x) { return 1 + std::cos(0.03 * x.sum()); });
    run(g, m, no_bodies(), {60, 0, 1e-7}, c);
    set_threads(1);
    return c;
  };
  const std::vector<double> one = result(1);
  EXPECT_EQ(one, result(2));
  EXPECT_EQ(one, result(3));
}

}  // namespace
}  // namespace acinus::substances
