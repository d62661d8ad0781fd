/// The preconditioner: symmetric, and good for any grid and length of step.

#include "substances/multigrid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers/random.hpp"
#include "substances/solve.hpp"

namespace acinus::substances {
namespace {

double number(std::uint64_t k) { return uniform({7, Purpose::kTest, k, 0, 0}); }

std::vector<double> numbers(std::size_t n, double low, double high, std::uint64_t salt) {
  std::vector<double> v(n);
  for (std::size_t k = 0; k < n; ++k) v[k] = low + (high - low) * number(k + 1000003 * salt);
  return v;
}

TEST(Multigrid, CycleIsSymmetric) {
  const std::array<int, 3> n{13, 6, 9};
  Multigrid grids;
  grids.resize(n);
  const std::size_t n_voxel = 13 * 6 * 9;
  grids.set(numbers(n_voxel, 1, 3, 1), {4, 5, 6});
  const PaddedLayout& at = grids.layout();
  const auto spread = [&](std::uint64_t salt) {
    std::vector<float> v(at.size, 0.0F);
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          v[at.row(j, k) + i] = static_cast<float>(number(at.row(j, k) + i + 77777 * salt) - 0.5);
    return v;
  };
  const std::vector<float> a = spread(1), b = spread(2);
  std::vector<float> ma(at.size, 0.0F), mb(at.size, 0.0F);
  grids.apply(a.data(), ma.data());
  grids.apply(b.data(), mb.data());
  double ab = 0, ba = 0, size = 0;
  for (std::size_t k = 0; k < at.size; ++k) {
    ab += static_cast<double>(a[k]) * mb[k];
    ba += static_cast<double>(b[k]) * ma[k];
    size += std::abs(static_cast<double>(a[k]) * mb[k]);
  }
  EXPECT_GT(grids.n_level(), 2U);
  EXPECT_NEAR(ab, ba, 1e-6 * size);  // single precision
}

TEST(Multigrid, NeedsFewIterationsForAnyStep) {
  for (const std::array<int, 3>& n :
       {std::array{48, 48, 48}, std::array{37, 50, 11}, std::array{64, 3, 1}}) {
    const std::size_t n_voxel = static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                                static_cast<std::size_t>(n[2]);
    Solver solver;
    solver.resize(n);
    for (const double conductance : {0.01, 1.0, 100.0, 1e5}) {
      StepSystem system;
      system.conductance.fill(conductance);
      system.own = numbers(n_voxel, 1, 10, 3);
      system.rhs = numbers(n_voxel, 0, 1, 4);
      std::vector<double> c(n_voxel, 0.0);
      const SolveResult result = solver.solve(system, 1e-8, c);
      std::printf("%d x %d x %d, D dt / h^2 = %g: %d iterations\n", n[0], n[1], n[2], conductance,
                  result.iterations);
      EXPECT_TRUE(result.converged);
      EXPECT_LE(result.iterations, 15);
    }
  }
}

TEST(Multigrid, SolvesWhatItIsGiven) {
  // A c computed by hand in a row of voxels.
  const std::array<int, 3> n{5, 1, 1};
  StepSystem system;
  system.conductance = {2, 2, 2};
  system.own = {1, 2, 3, 4, 5};
  const std::vector<double> exact{3, 1, 4, 1, 5};
  system.rhs.resize(5);
  for (int i = 0; i < 5; ++i) {
    system.rhs[i] = system.own[i] * exact[i];
    if (i > 0) system.rhs[i] += 2 * (exact[i] - exact[i - 1]);
    if (i < 4) system.rhs[i] += 2 * (exact[i] - exact[i + 1]);
  }
  Solver solver;
  solver.resize(n);
  std::vector<double> c(5, 0.0);
  EXPECT_TRUE(solver.solve(system, 1e-13, c).converged);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(c[i], exact[i], 1e-11);
}

}  // namespace
}  // namespace acinus::substances
