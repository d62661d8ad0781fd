#include "core/solve/operator.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstdio>

#include "tests/core/solve/systems.hpp"

namespace acinus::solve {
namespace {

using reference::kEps;

TEST(Operator, ProductIsThatOfTheDenseMatrix) {
  double worst = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const System s = make_system(100 + seed);
    const Eigen::MatrixXd dense = reference::make_dense(s);
    Operator op;
    op.prepare(s);
    const std::vector<double> x = random_vector_of(s, 200 + seed);
    std::vector<double> y(x.size(), 1e300);  // must be overwritten
    op.apply(x, y);
    const Eigen::VectorXd expected = dense * as_eigen(x);
    worst = std::max(
        worst, (as_eigen(y) - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
    EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(),
              16 * kEps * dense.cwiseAbs().maxCoeff());
  }
  std::printf("product against dense %.1e\n", worst);
  EXPECT_LT(worst, 256 * kEps);  // about 200 terms a row
}

TEST(Operator, ExternalProductHasMediumAndSurroundingsOnly) {
  const System s = make_system(1);
  System external = s;
  for (double& d : external.diagonal) d = 0;
  for (double& u : external.upper) u = 0;
  external.rank_one.clear();
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int k : {0, 3, 5})
      for (std::size_t l = 0; l < kLanes; ++l)
        external.diagonal[row * kSymStride + static_cast<std::size_t>(k) * kLanes + l] =
            s.friction_scale * s.medium[row * kLanes + l];
  for (std::size_t k = 0; k < s.links.size(); ++k)
    if (!s.links.external[k]) external.links.friction[k] = external.links.stiffness[k] = {};
  Operator op;
  op.prepare(s);
  const std::vector<double> x = random_vector_of(s, 2);
  std::vector<double> y(x.size(), 1e300);
  op.apply_external(x, y);
  const Eigen::VectorXd expected = reference::make_dense(external) * as_eigen(x);
  EXPECT_LT((as_eigen(y) - expected).norm(), 64 * kEps * expected.norm());
}

TEST(Operator, PreconditionerInvertsTheDiagonalBlocks) {
  const System s = make_system(3);
  const Eigen::MatrixXd dense = reference::make_dense(s);
  Operator op;
  op.prepare(s);
  const std::vector<double> x = random_vector_of(s, 4);
  std::vector<double> y(x.size());
  op.precondition(x, y);
  double worst = 0;
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l) {
      const Address a = make_address(row, l);
      Mat3 d;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          d(r, c) =
              dense(a + static_cast<Address>(r * kLanes), a + static_cast<Address>(c * kLanes));
      const Vec3 expected = d.fullPivLu().solve(load_point(x.data(), a));
      const double condition = d.norm() * d.inverse().norm();
      worst = std::max(worst, (load_point(y.data(), a) - expected).norm() /
                                  (expected.norm() * condition * condition));
    }
  std::printf("preconditioner %.1e (over the squared condition of a block)\n", worst);
  EXPECT_LT(worst, 16 * kEps);  // inverse by cofactors
}

TEST(Operator, DotIsTheDotProduct) {
  const System s = make_system(5);
  Operator op;
  op.prepare(s);
  const auto a = random_vector_of(s, 6), b = random_vector_of(s, 7);
  EXPECT_NEAR(op.dot(a, b), as_eigen(a).dot(as_eigen(b)),
              64 * kEps * as_eigen(a).norm() * as_eigen(b).norm());
}

TEST(Operator, LinkForcesAreScatteredByWeight) {
  const System s = make_system(8);
  Operator op;
  op.prepare(s);
  std::vector<double> pair(s.n_dof(), 0.5), external(s.n_dof(), 0.25);  // added to, not overwritten
  op.add_link_forces(pair, external);
  Eigen::VectorXd expected_pair =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(s.n_dof()), 0.5);
  Eigen::VectorXd expected_external = Eigen::VectorXd::Constant(expected_pair.size(), 0.25);
  for (std::size_t l = 0; l < s.links.size(); ++l)
    for (std::uint32_t k = s.links.start[l]; k < s.links.start[l + 1]; ++k)
      for (Address c = 0; c < 3; ++c)
        (s.links.external[l] ? expected_external : expected_pair)(
            s.links.address[k] + c * kLanes) += s.links.weight[k] * s.links.force[l][c];
  EXPECT_LT((as_eigen(pair) - expected_pair).cwiseAbs().maxCoeff(), 64 * kEps);
  EXPECT_LT((as_eigen(external) - expected_external).cwiseAbs().maxCoeff(), 64 * kEps);
  Vec3 net = Vec3::Zero();
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l)
      net += load_point(pair.data(), make_address(row, l)) - Vec3::Constant(0.5);
  EXPECT_LT(net.norm(), 1024 * kEps);
}

TEST(Operator, SameBitsForAnyNumberOfThreads) {
  const System s = make_system(9);
  const auto x = random_vector_of(s, 10), z = random_vector_of(s, 11);
  const int before = omp_get_max_threads();
  std::vector<std::vector<double>> product, external, preconditioned, force;
  std::vector<double> dot;
  for (int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Operator op;
    op.prepare(s);
    for (auto* v : {&product, &external, &preconditioned, &force}) v->emplace_back(s.n_dof());
    op.apply(x, product.back());
    op.apply_external(x, external.back());
    op.precondition(x, preconditioned.back());
    op.add_link_forces(force.back(), force.back());
    dot.push_back(op.dot(x, z));
  }
  omp_set_num_threads(before);
  for (std::size_t k : {std::size_t{1}, std::size_t{2}}) {
    EXPECT_EQ(product[0], product[k]);
    EXPECT_EQ(external[0], external[k]);
    EXPECT_EQ(preconditioned[0], preconditioned[k]);
    EXPECT_EQ(force[0], force[k]);
    EXPECT_EQ(dot[0], dot[k]);
  }
}

TEST(Links, AppendKeepsOrderAndStencils) {
  const System a = make_system(12), b = make_system(13);
  Links joined = a.links;
  joined.append(b.links);
  ASSERT_EQ(joined.size(), a.links.size() + b.links.size());
  const std::size_t n = a.links.size();
  for (std::size_t l = 0; l < b.links.size(); ++l) {
    ASSERT_EQ(joined.start[n + l + 1] - joined.start[n + l],
              b.links.start[l + 1] - b.links.start[l]);
    for (std::uint32_t k = 0; k < b.links.start[l + 1] - b.links.start[l]; ++k) {
      EXPECT_EQ(joined.address[joined.start[n + l] + k], b.links.address[b.links.start[l] + k]);
      EXPECT_EQ(joined.weight[joined.start[n + l] + k], b.links.weight[b.links.start[l] + k]);
    }
    EXPECT_EQ(joined.force[n + l], b.links.force[l]);
  }
}

}  // namespace
}  // namespace acinus::solve
