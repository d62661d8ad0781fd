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
    const double energy = op.apply(x, y);
    const Eigen::VectorXd expected = dense * as_eigen(x);
    EXPECT_NEAR(energy, as_eigen(x).dot(expected),
                256 * kEps * as_eigen(x).norm() * expected.norm());
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

TEST(Operator, DescendAndRedirectAreTheStepsOfConjugateGradients) {
  const System s = make_system(14);
  Operator op;
  op.prepare(s);
  const auto p = random_vector_of(s, 15), q = random_vector_of(s, 16);
  auto x = random_vector_of(s, 17), r = random_vector_of(s, 18), z = random_vector_of(s, 19);
  const Eigen::VectorXd x_after = as_eigen(x) + 0.3 * as_eigen(p);
  const Eigen::VectorXd r_after = as_eigen(r) - 0.3 * as_eigen(q);
  const double rho = op.descend(0.3, p, q, x, r, z);
  EXPECT_LT((as_eigen(x) - x_after).cwiseAbs().maxCoeff(), 8 * kEps);
  EXPECT_LT((as_eigen(r) - r_after).cwiseAbs().maxCoeff(), 8 * kEps);
  std::vector<double> expected(r.size());
  op.precondition(r, expected);
  EXPECT_EQ(z, expected);
  EXPECT_NEAR(rho, op.dot(r, z), 64 * kEps * as_eigen(r).norm() * as_eigen(z).norm());
  auto direction = p;
  op.redirect(z, 0.7, direction);
  const Eigen::VectorXd redirected = as_eigen(z) + 0.7 * as_eigen(p);
  EXPECT_LT((as_eigen(direction) - redirected).norm(), 8 * kEps * redirected.norm());
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
  const System s = make_system(9, 80);  // 567 rows: threads do start
  const auto x = random_vector_of(s, 10), other = random_vector_of(s, 11);
  const int before = omp_get_max_threads();
  std::vector<std::vector<std::vector<double>>> seen;
  for (int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Operator op;
    op.prepare(s);
    std::vector<std::vector<double>> v(5, std::vector<double>(s.n_dof()));
    std::vector<double> number;
    number.push_back(op.apply(x, v[0]));
    op.apply_external(x, v[1]);
    op.precondition(x, v[2]);
    op.add_link_forces(v[3], v[3]);
    number.push_back(op.dot(x, other));
    auto r = other;
    number.push_back(op.descend(0.4, x, v[0], v[4], r, v[2]));
    op.redirect(r, 0.6, v[4]);
    v.push_back(r);
    v.push_back(number);
    seen.push_back(v);
  }
  omp_set_num_threads(before);
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
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
