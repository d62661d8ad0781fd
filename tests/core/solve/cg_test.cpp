#include "core/solve/cg.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/core/solve/systems.hpp"

namespace acinus::solve {
namespace {

struct Solved {
  System system = make_system(1);
  Operator op;
  std::vector<double> rhs = random_vector_of(system, 2), x = std::vector<double>(rhs.size());
  CgWorkspace work;
  CgResult result;
  Solved() { op.prepare(system); }
  void run(double tolerance, BlockRange range = {}) {
    result = solve_cg(op, rhs, x, {tolerance, 2000}, work, range);
  }
  Eigen::VectorXd exact() const {
    return reference::make_dense(system).ldlt().solve(as_eigen(rhs));
  }
  /// sqrt(r D^-1 r) of the residual of x over that of the right-hand side, worked out here.
  double true_residual() const {
    const Eigen::MatrixXd a = reference::make_dense(system);
    const Eigen::VectorXd r = as_eigen(rhs) - a * as_eigen(x);
    const auto norm = [&](const Eigen::VectorXd& v) {
      const std::vector<double> in(v.data(), v.data() + v.size());
      std::vector<double> out(in.size());
      op.precondition(in, out);
      return std::sqrt(v.dot(as_eigen(out)));
    };
    return norm(r) / norm(as_eigen(rhs));
  }
};

TEST(Cg, ConvergesToTheDenseSolution) {
  Solved s;
  s.run(1e-12);
  ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
  const Eigen::VectorXd exact = s.exact();
  const double error = (as_eigen(s.x) - exact).norm() / exact.norm();
  std::printf("CG: %d iterations, residual %.1e, error %.1e\n", s.result.iterations,
              s.result.residual, error);
  EXPECT_LT(error, 1e-9);  // condition of this matrix is below 1e3
}

TEST(Cg, StopsAtTheToleranceRelativeToTheRightHandSide) {
  int last = 0;
  for (double tolerance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    Solved s;
    s.run(tolerance);
    ASSERT_TRUE(s.result.status.ok);
    EXPECT_LE(s.true_residual(), tolerance * (1 + 1e-6));
    EXPECT_NEAR(s.result.residual, s.true_residual(), 1e-6 * tolerance + 1e-13);
    EXPECT_GT(s.result.iterations, last);
    last = s.result.iterations;
  }
  // A start far off does not loosen the goal.
  Solved far;
  for (double& x : far.x) x = 1e6;
  far.run(1e-6);
  ASSERT_TRUE(far.result.status.ok);
  EXPECT_LE(far.true_residual(), 1e-6 * (1 + 1e-3));
}

TEST(Cg, WarmStartSavesIterations) {
  Solved s;
  s.run(1e-12);
  const std::vector<double> exact = s.x;
  s.run(1e-10);
  EXPECT_EQ(s.result.iterations, 0);
  EXPECT_EQ(s.x, exact);
  Solved cold, warm;
  cold.run(1e-6);
  for (std::size_t k = 0; k < exact.size(); ++k) warm.x[k] = 0.99 * exact[k];
  warm.run(1e-6);
  std::printf("CG to 1e-6: %d cold, %d from 99 %%\n", cold.result.iterations,
              warm.result.iterations);
  EXPECT_LT(warm.result.iterations, cold.result.iterations);
}

TEST(Cg, RangeSolvesTheSubBlockAndLeavesTheRest) {
  for (const BlockRange range : {BlockRange{1, 2}, BlockRange{0, 1}, BlockRange{2, 4}}) {
    Solved s;
    s.x = random_vector_of(s.system, 3);
    const std::vector<double> before = s.x;
    s.run(1e-12, range);
    ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
    const auto& block = s.system.block;
    const auto from = static_cast<Eigen::Index>(block[range.first].first_row * kPointStride);
    const auto to = static_cast<Eigen::Index>(
        (range.last < block.size() ? block[range.last].first_row : s.system.n_row) * kPointStride);
    const Eigen::MatrixXd a = reference::make_dense(s.system);
    Eigen::VectorXd frozen = as_eigen(before);
    frozen.segment(from, to - from).setZero();
    const Eigen::VectorXd rhs = (as_eigen(s.rhs) - a * frozen).segment(from, to - from);
    const Eigen::VectorXd exact = a.block(from, from, to - from, to - from).ldlt().solve(rhs);
    EXPECT_LT((as_eigen(s.x).segment(from, to - from) - exact).norm(), 1e-9 * exact.norm());
    for (std::size_t k = 0; k < before.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (i < from || i >= to) {
        ASSERT_EQ(s.x[k], before[k]);
      }
    }
  }
}

TEST(Cg, ZeroRightHandSideGivesZero) {
  Solved s;
  s.x = random_vector_of(s.system, 4);
  s.rhs.assign(s.rhs.size(), 0.0);
  s.run(1e-6);
  EXPECT_TRUE(s.result.status.ok);
  for (double x : s.x) ASSERT_EQ(x, 0);
}

// A frozen partner pushes even when the range itself has no load of its own.
TEST(Cg, ZeroLoadInTheRangeStillFeelsTheFrozenRest) {
  Solved s;
  s.x = random_vector_of(s.system, 5);
  const std::size_t from = s.system.block[1].first_row * kPointStride,
                    to = s.system.block[2].first_row * kPointStride;
  for (std::size_t k = from; k < to; ++k) s.rhs[k] = s.x[k] = 0;
  s.run(1e-10, {1, 2});
  const Eigen::MatrixXd a = reference::make_dense(s.system);
  const Eigen::VectorXd r = as_eigen(s.rhs) - a * as_eigen(s.x);
  EXPECT_GT(s.result.iterations, 0);
  const auto first = static_cast<Eigen::Index>(from), n = static_cast<Eigen::Index>(to - from);
  ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
  EXPECT_LT(r.segment(first, n).norm(), 1e-8 * as_eigen(s.x).norm());
}

TEST(Cg, SameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  const System system = make_system(6, 80);  // 567 rows: threads do start
  const auto rhs = random_vector_of(system, 7);
  std::vector<std::vector<double>> x;
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    Operator op;
    op.prepare(system);
    CgWorkspace work;
    x.emplace_back(rhs.size());
    const CgResult result = solve_cg(op, rhs, x.back(), {1e-8, 2000}, work);
    EXPECT_TRUE(result.status.ok) << result.status.cause;
  }
  omp_set_num_threads(before);
  EXPECT_EQ(x[0], x[1]);
}

TEST(Cg, FailsOnANonFiniteRightHandSide) {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Solved s;
    s.rhs[17] = bad;
    s.run(1e-6);
    EXPECT_FALSE(s.result.status.ok);
    EXPECT_FALSE(s.result.status.cause.empty());
  }
}

TEST(Cg, FailsOnANonFiniteStart) {
  Solved s;
  s.x[3] = std::nan("");
  s.run(1e-6);
  EXPECT_FALSE(s.result.status.ok);
}

TEST(Cg, FailsOnAnIndefiniteMatrix) {
  const BlockPattern two{2, {{0, 1}}};
  System s;
  set_blocks(s, {{&two, 0, 0}});
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t k : {0, 3, 5})
      for (std::size_t l = 0; l < kLanes; ++l) s.diagonal[row * kSymStride + k * kLanes + l] = 1;
  s.upper[5] = 2;  // lane 5, xx: eigenvalues 3 and -1
  Operator op;
  op.prepare(s);
  std::vector<double> b(s.n_dof(), 0.0), x(s.n_dof(), 0.0);
  b[5] = 1;
  b[kPointStride + 5] = -1;
  CgWorkspace work;
  const CgResult r = solve_cg(op, b, x, {}, work);
  EXPECT_FALSE(r.status.ok);
  EXPECT_NE(r.status.cause.find("definite"), std::string::npos);
}

TEST(Cg, FailsWhenIterationsRunOut) {
  Solved s;
  s.result = solve_cg(s.op, s.rhs, s.x, {1e-10, 3}, s.work);
  EXPECT_FALSE(s.result.status.ok);
  EXPECT_EQ(s.result.iterations, 3);
}

}  // namespace
}  // namespace acinus::solve
