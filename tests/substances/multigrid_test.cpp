/// The preconditioner: symmetric, and good for any grid and length of step.

#include "substances/multigrid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers/random.hpp"
#include "substances/grid.hpp"
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
  for (const std::array<int, 3>& n : {std::array{48, 48, 48}, std::array{37, 50, 11},
                                      std::array{64, 3, 1}, std::array{1, 40, 65}}) {
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
      EXPECT_LE(result.iterations, 10);
    }
  }
}

TEST(Solver, ScalesAStartThatDecaysAsAWhole) {
  const std::array<int, 3> n{20, 15, 12};
  const std::size_t n_voxel = 20 * 15 * 12;
  Solver solver;
  solver.resize(n);
  StepSystem system;
  system.conductance.fill(100);
  system.own.assign(n_voxel, 1.7);
  system.rhs.assign(n_voxel, 38);
  std::vector<double> c(n_voxel, 38);
  EXPECT_EQ(solver.solve(system, 1e-9, c).iterations, 0);
  for (const double value : c) EXPECT_NEAR(value, 38 / 1.7, 1e-9);
  // A start of the wrong sign or of zeros cannot be scaled and is no obstacle.
  for (const double start : {0.0, -5.0}) {
    c.assign(n_voxel, start);
    EXPECT_TRUE(solver.solve(system, 1e-9, c).converged);
    EXPECT_NEAR(c[77], 38 / 1.7, 1e-6);
  }
}

/// Random open fractions of faces, a third of them closed, and voxels of which a fifth are closed.
struct RandomObstacles {
  std::array<int, 3> n{13, 6, 9};
  std::array<std::vector<double>, 3> face;
  std::vector<double> own;
  RandomObstacles() {
    VoxelGrid g;
    g.n = n;
    own = numbers(g.n_voxel(), 0, 1, 11);
    for (int axis = 0; axis < 3; ++axis)
      for (const double x : numbers(g.n_face(axis), -0.5, 1, 12 + static_cast<unsigned>(axis)))
        face[axis].push_back(std::max(0.0, x));
    std::size_t v = 0;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i, ++v) {
          if (own[v] > 0.2) continue;
          own[v] = 0;
          for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1})
              face[axis][g.face_index(axis, i + (axis == 0 ? side : 0), j + (axis == 1 ? side : 0),
                                      k + (axis == 2 ? side : 0))] = 0;
        }
  }
  /// Numbers in open voxels.
  template <class T>
  std::vector<T> spread(const PaddedLayout& at, std::uint64_t salt) const {
    std::vector<T> x(at.size, T{0});
    std::size_t v = 0;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i, ++v)
          if (own[v] > 0) x[at.row(j, k) + i] = static_cast<T>(number(v + 77777 * salt) - 0.5);
    return x;
  }
};

template <class T>
double product(const std::vector<T>& a, const std::vector<T>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += static_cast<double>(a[k]) * b[k];
  return sum;
}

TEST(Multigrid, MatrixAmongObstaclesIsSymmetricAndPositive) {
  const RandomObstacles o;
  Level<double> level;
  level.layout = make_layout(o.n);
  for (int axis = 0; axis < 3; ++axis) level.width[axis].assign(o.n[axis], 1.0);
  set_faces({40, 50, 60}, level);
  set_partial_faces({40, 50, 60}, o.face, level);
  set_diagonal<double>(o.own, level);
  std::vector<double> aa(level.layout.size, 0.0), ab = aa;
  for (std::uint64_t salt = 1; salt < 20; ++salt) {
    const std::vector<double> a = o.spread<double>(level.layout, salt),
                              b = o.spread<double>(level.layout, salt + 100);
    EXPECT_GT(multiply(level, a.data(), aa.data()), 0);
    multiply(level, b.data(), ab.data());
    EXPECT_NEAR(product(b, aa), product(a, ab), 1e-12 * product(aa, aa));
  }
}

TEST(Multigrid, CycleAmongObstaclesIsSymmetricAndPositive) {
  const RandomObstacles o;
  Multigrid grids;
  grids.resize(o.n);
  grids.set(o.own, {40, 50, 60}, &o.face);
  const PaddedLayout& at = grids.layout();
  std::vector<float> ma(at.size, 0.0F), mb = ma;
  for (std::uint64_t salt = 1; salt < 20; ++salt) {
    const std::vector<float> a = o.spread<float>(at, salt), b = o.spread<float>(at, salt + 100);
    grids.apply(a.data(), ma.data());
    grids.apply(b.data(), mb.data());
    EXPECT_GT(product(a, ma), 0);
    // Single precision: the sizes of the terms times some of its epsilon.
    const double size = std::sqrt(product(a, ma) * product(b, mb));
    EXPECT_NEAR(product(b, ma), product(a, mb), 1e-5 * size);
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
