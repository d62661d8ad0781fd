#include "solve/cg.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/parallel/threads.hpp"
#include "tests/messages.hpp"
#include "tests/solve/systems.hpp"

namespace acinus::solve {
namespace {

struct Solved {
  System system = make_system(1);
  Operator op;
  std::vector<double> rhs = random_vector_of(system, 2), x = std::vector<double>(rhs.size());
  CgWorkspace work;
  CgResult result;
  Precision precision = Precision::kMixed;
  Solved() { op.prepare(system); }
  explicit Solved(Precision p) : precision(p) { op.prepare(system); }
  void run(double tolerance) {
    result = solve_cg({op, rhs}, x, {tolerance, 2000, precision}, work);
  }
  Eigen::VectorXd exact() const {
    return reference::make_dense(system).ldlt().solve(as_eigen(rhs));
  }
  /// Residual b - A x of the dense matrix.
  Eigen::VectorXd residual() const {
    return as_eigen(rhs) - reference::make_dense(system) * as_eigen(x);
  }
  /// sqrt(r D^-1 r) of the residual of x over that of the right-hand side.
  double true_residual() const {
    const auto norm = [&](const Eigen::VectorXd& v) {
      const std::vector<double> in(v.data(), v.data() + v.size());
      std::vector<double> out(in.size());
      op.precondition(in, out);
      return std::sqrt(v.dot(as_eigen(out)));
    };
    return norm(residual()) / norm(as_eigen(rhs));
  }
  /// True if a pass ran in double.
  bool used_double() const { return result.double_passes > 0; }
};

constexpr Precision kBoth[] = {Precision::kMixed, Precision::kDouble};

TEST(Cg, ConvergesToTheDenseSolution) {
  for (const Precision precision : kBoth) {
    Solved s(precision);
    s.run(1e-12);
    ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
    const Eigen::VectorXd exact = s.exact();
    const double error = (as_eigen(s.x) - exact).norm() / exact.norm();
    std::printf("CG: %d iterations, residual %.1e, error %.1e\n", s.result.iterations,
                s.result.residual, error);
    EXPECT_LT(error, 1e-9);  // condition of this matrix is below 1e3
  }
}

// Floats carry the iterations, not the answer.
TEST(Cg, MixedPrecisionReachesTheToleranceOfDouble) {
  for (double tolerance : {1e-3, 1e-6, 1e-10}) {
    int iterations[2] = {};
    for (const Precision precision : kBoth) {
      Solved s(precision);
      s.run(tolerance);
      ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
      EXPECT_EQ(s.used_double(), precision == Precision::kDouble);
      EXPECT_EQ(s.result.float_passes == 0, precision == Precision::kDouble);
      EXPECT_LE(s.true_residual(), tolerance * (1 + 1e-6));
      EXPECT_NEAR(s.result.residual, s.true_residual(), 1e-6 * tolerance + 1e-13);
      iterations[precision == Precision::kDouble ? 1 : 0] = s.result.iterations;
    }
    std::printf("CG to %.0e: %d iterations mixed, %d in double\n", tolerance, iterations[0],
                iterations[1]);
    // a pass gains four digits and then starts its directions afresh
    EXPECT_LE(iterations[0], 1.25 * iterations[1]);
  }
}

TEST(Cg, WorkspaceHoldsTheResidualOfTheSolution) {
  for (const Precision precision : kBoth)
    for (double tolerance : {1e-1, 1e-3, 1e-10}) {
      Solved s(precision);
      s.x = random_vector_of(s.system, 8);
      s.run(tolerance);
      ASSERT_TRUE(s.result.status.ok);
      const double size = as_eigen(s.rhs).cwiseAbs().maxCoeff() +
                          as_eigen(s.x).cwiseAbs().maxCoeff() *
                              reference::make_dense(s.system).cwiseAbs().rowwise().sum().maxCoeff();
      EXPECT_LT((as_eigen(s.work.residual) - s.residual()).cwiseAbs().maxCoeff(),
                16 * reference::kEps * size);
    }
}

// Contacts and springs a hundred million times stiffer than what holds the chain as a whole.
TEST(Cg, MixedPrecisionSolvesAStiffChain) {
  auto random = reference::stream(9);
  for (double stiff : {1e2, 1e5, 1e8}) {
    Solved s;
    s.system = System{};
    set_blocks(s.system, {block_of(kSingle), block_of(kSingle)});
    for (double& m : s.system.medium) m = random.uniform(0.05, 0.2);
    for (Point p = 0; p + 1 < 2 * kLanes; ++p) {
      const double stiffness = stiff * random.uniform(0.5, 2),
                   friction = stiff * random.uniform(0.5, 2);
      s.system.point_links.push_back(
          make_point_link(p, p + 1, random.unit_vector(), stiffness, friction));
    }
    s.op.prepare(s.system);
    s.rhs = random_vector_of(s.system, 10);
    s.x.assign(s.rhs.size(), 0.0);
    s.run(1e-3);
    ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
    std::printf("chain %.0e: %d iterations, residual %.1e\n", stiff, s.result.iterations,
                s.true_residual());
    if (stiff < 1e8) {
      EXPECT_FALSE(s.used_double());
    }
    // the product rounds: 1e-16 of stiffness times displacement (1 / medium)
    EXPECT_LE(s.true_residual(), 1e-3 * (1 + 1e-3));
  }
}

// A pass works on the residual scaled to one: neither overflow nor underflow.
TEST(Cg, LoadsFarOutOfRangeOfFloatsAreSolvedInFloat) {
  for (double factor : {1e25, 1e-25}) {
    Solved s;
    for (double& b : s.rhs) b *= factor;
    s.run(1e-6);
    ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
    EXPECT_LE(s.true_residual(), 1e-6 * (1 + 1e-6)) << factor;
    EXPECT_GT(s.result.iterations, 0);
    EXPECT_FALSE(s.used_double());
  }
}

// With any right-hand side an indefinite diagonal block is an error.
TEST(Cg, IndefiniteSpringIsReported) {
  static const BlockPattern kPair{2, {{0, 1}}, {}, {}};
  auto random = reference::stream(31);
  for (int k = 0; k < 20; ++k) {
    Solved s;
    s.system = System{};
    set_blocks(s.system, {block_of(kPair)});
    for (double& m : s.system.medium) m = 1;
    for (std::size_t l = 0; l < kLanes; ++l) {
      s.system.spring[kLanes + l] = -1.5f;
    }
    s.op.prepare(s.system);
    s.rhs.assign(s.system.n_dof(), 0.0);
    for (double& b : s.rhs) b = random.uniform(-1, 1);
    s.x.assign(s.rhs.size(), 0.0);
    s.run(1e-3);
    EXPECT_FALSE(s.result.status.ok);
  }
}

// Spheres in a thin liquid: friction far below the contact's stiffness leaves nothing of a block in
// float; the preconditioner stays positive all the same.
TEST(Cg, ContactsAlmostFreeToSlideAreSolved) {
  auto random = reference::stream(32);
  for (double medium : {1e-6, 1e-8, 1e-10}) {
    Solved s;
    s.system = System{};
    set_blocks(s.system, {block_of(kSingle)});
    for (double& m : s.system.medium) m = medium;
    for (Point p = 0; p < kLanes; p += 2)
      s.system.point_links.push_back(make_point_link(p, p + 1, random.unit_vector(), 1, 0));
    s.op.prepare(s.system);
    s.rhs = random_vector_of(s.system, 33);
    s.x.assign(s.rhs.size(), 0.0);
    s.run(1e-3);
    EXPECT_TRUE(s.result.status.ok) << medium << ": " << s.result.status.cause;
    EXPECT_LE(s.result.residual, 1e-3) << medium;
  }
}

// Numbers that a double holds and a float does not: the pass breaks down and is done again.
TEST(Cg, PassThatBreaksDownInFloatIsRepeatedInDouble) {
  Solved pinned, steep;
  pinned.system.medium[3] = 1e39;                  // a point that nothing moves
  for (RankOne& family : steep.system.rank_one) {  // c g g^T as before, c out of range
    for (double& c : family.coefficient) c *= 1e45;
    for (float& g : family.vector) g = static_cast<float>(static_cast<double>(g) / std::sqrt(1e45));
  }
  for (auto* s : {&pinned, &steep}) {
    s->op.prepare(s->system);
    s->run(1e-8);
    ASSERT_TRUE(s->result.status.ok) << s->result.status.cause;
    EXPECT_GT(s->result.float_passes, 0);
    EXPECT_TRUE(s->used_double());
    EXPECT_LE(s->true_residual(), 1e-8 * (1 + 1e-6));
  }
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
  // A start that all but fulfils it is still not good enough.
  for (const Precision precision : kBoth) {
    Solved near(precision);
    near.run(1e-3);
    const double stricter = 0.8 * near.result.residual;
    near.run(stricter);
    ASSERT_TRUE(near.result.status.ok);
    EXPECT_GT(near.result.iterations, 0);
    EXPECT_LE(near.true_residual(), stricter * (1 + 1e-6));
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

TEST(Cg, ZeroRightHandSideGivesZero) {
  Solved s;
  s.x = random_vector_of(s.system, 4);
  s.rhs.assign(s.rhs.size(), 0.0);
  s.run(1e-6);
  EXPECT_TRUE(s.result.status.ok);
  for (double x : s.x) ASSERT_EQ(x, 0);
}

TEST(Cg, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  const System system = make_system(6, 80);  // 567 rows: threads do start
  const auto rhs = random_vector_of(system, 7);
  for (const Precision precision : kBoth) {
    std::vector<std::vector<double>> x, residual;
    std::vector<int> iterations;
    for (int threads : {1, 2, 3}) {
      set_threads(threads);
      Operator op;
      op.prepare(system);
      CgWorkspace work;
      x.emplace_back(rhs.size());
      const CgResult result = solve_cg({op, rhs}, x.back(), {1e-8, 2000, precision}, work);
      EXPECT_TRUE(result.status.ok) << result.status.cause;
      residual.emplace_back(work.residual.begin(), work.residual.end());
      iterations.push_back(result.iterations);
    }
    set_threads(before);
    for (std::size_t k : {1, 2}) {
      EXPECT_EQ(x[0], x[k]);
      EXPECT_EQ(residual[0], residual[k]);
      EXPECT_EQ(iterations[0], iterations[k]);
    }
  }
}

TEST(Cg, AKnownResidualChangesNothing) {
  for (const Precision precision : kBoth) {
    Solved s(precision), t(precision);
    s.x = t.x = random_vector_of(s.system, 14);
    s.run(1e-8);
    std::vector<double> product(t.x.size());
    t.op.apply(t.x, product);
    t.work.residual.resize(product.size());
    for (std::size_t k = 0; k < product.size(); ++k) t.work.residual[k] = t.rhs[k] - product[k];
    t.work.load = s.work.load;
    t.result = continue_cg({t.op, t.rhs}, t.x, {1e-8, 2000, precision}, t.work);
    EXPECT_EQ(s.x, t.x);
    EXPECT_EQ(s.work.residual, t.work.residual);
    EXPECT_EQ(s.result.iterations, t.result.iterations);
    EXPECT_GT(s.result.iterations, 3);
  }
}

TEST(Cg, ContinuesAfterAChangeWithThePreconditionerOfBefore) {
  for (const Precision precision : kBoth) {
    Solved s(precision);
    s.run(1e-8);
    const double load = s.work.load;
    Link& link = s.system.links.link[1];  // twice as stiff and as rough
    link.stiffness *= 2;
    link.friction *= 2;
    s.rhs[0] += 0.3;
    s.op.update_links({});
    const Eigen::VectorXd residual = s.residual();
    std::ranges::copy(residual, s.work.residual.begin());
    const CgProblem problem{s.op, s.rhs};
    const CgOptions options{1e-6, 2000, precision};
    s.result = continue_cg(problem, s.x, options, s.work);
    ASSERT_TRUE(s.result.status.ok) << s.result.status.cause;
    EXPECT_GT(s.result.iterations, 0);
    EXPECT_EQ(s.work.load, load);
    const std::vector<double> left(s.work.residual.begin(), s.work.residual.end());
    EXPECT_LE(std::sqrt(s.op.precondition(left, {})), 1e-6 * load);
    EXPECT_LT((as_eigen(left) - s.residual()).norm(), 1e-12 * as_eigen(s.rhs).norm());
    const std::vector<double> x = s.x;
    EXPECT_EQ(continue_cg(problem, s.x, options, s.work).iterations, 0);
    EXPECT_EQ(s.x, x) << "what is solved stays as it is";
  }
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
  const BlockPattern two{2, {{0, 1}}, {}, {}};
  for (const Precision precision : kBoth) {
    System s;
    set_blocks(s, {block_of(two)});
    std::ranges::fill(s.medium, 1.0);
    s.spring[kLanes + 5] = -0.75f;  // lane 5: eigenvalues 1 and -1/2, diagonal still positive
    Operator op;
    op.prepare(s);
    std::vector<double> b(s.n_dof(), 0.0), x(s.n_dof(), 0.0);
    b[5] = 1;
    b[kPointStride + 5] = -1;
    CgWorkspace work;
    CgResult r = solve_cg({op, b}, x, {1e-3, 2000, precision}, work);
    EXPECT_FALSE(r.status.ok);
    EXPECT_CONTAINS(r.status.cause, "definite");
    EXPECT_EQ(x, std::vector<double>(s.n_dof(), 0.0)) << "a failed pass moves nothing";
    // Found too when the load lies mostly in what is sound, and from a warm start.
    b = random_vector_of(s, 12);
    x = random_vector_of(s, 13);
    r = solve_cg({op, b}, x, {1e-6, 2000, precision}, work);
    EXPECT_FALSE(r.status.ok);
    EXPECT_CONTAINS(r.status.cause, "definite");
  }
}

TEST(Cg, FailsWhenIterationsRunOut) {
  for (const Precision precision : kBoth)
    for (int most : {3, 40}) {  // in the first pass; in a later one
      Solved s(precision);
      s.result = solve_cg({s.op, s.rhs}, s.x, {1e-10, most, precision}, s.work);
      EXPECT_FALSE(s.result.status.ok);
      EXPECT_EQ(s.result.iterations, most);
    }
}

}  // namespace
}  // namespace acinus::solve
