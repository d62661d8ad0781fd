#include "solve/coarse.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/parallel/threads.hpp"
#include "solve/cg.hpp"
#include "tests/solve/systems.hpp"

namespace acinus::solve {
namespace {

using CellPairs = std::vector<std::array<std::size_t, 2>>;

/// Cells of which some hold on to each other.
struct JoinedCells {
  System system;
  std::vector<double> position;
  std::vector<std::uint8_t> active;
  Operator op;
  CoarseSpace coarse;
  RowVector<double> mode, product;

  JoinedCells(const std::vector<Block>& blocks, const CellPairs& pairs, double medium,
              double hold) {
    auto random = reference::stream(70);
    system.friction_scale = 0.5;
    set_blocks(system, blocks);
    for (double& m : system.medium) m = medium * random.uniform(0.5, 2);
    fill_elements(system, random);
    position.resize(system.n_dof());
    for (double& x : position) x = random.uniform(-3, 3);
    active.assign(system.block.size() * kLanes, 1);
    active[5] = 0;
    auto point_of = [&](std::size_t cell, std::size_t i) {
      const Block& b = system.block[cell / kLanes];
      return static_cast<Point>((b.first_row + i % static_cast<std::size_t>(b.pattern->n_point)) *
                                    kLanes +
                                cell % kLanes);
    };
    for (const auto& [c, d] : pairs) {
      if (!active[c] || !active[d]) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        Link link;
        link.a = system.block[c / kLanes].pattern->n_point > 1
                     ? Side{{point_of(c, k), point_of(c, k + 1), point_of(c, k + 2)}, {0.25f, 0.5f}}
                     : Side::at(point_of(c, 0));
        link.b = Side::at(point_of(d, k));
        const Vec3 normal = random.unit_vector();
        const double friction = hold * random.uniform(1, 3),
                     stiffness = hold * random.uniform(1, 3);
        set_law(stiffness, friction, 0, normal, link);
        system.links.link.push_back(link);
        system.links.law.push_back({});
      }
    }
    op.prepare(system);
    coarse.prepare(op, {position, active, mode, product});
  }

  std::vector<int> rows_of_cell() const {
    std::vector<int> rows;
    for (std::size_t c = 0; c < active.size(); ++c)
      if (active[c]) rows.push_back(system.block[c / kLanes].pattern->n_point > 1 ? 6 : 3);
    return rows;
  }

  /// Six motions of every cell, three of a sphere.
  Eigen::MatrixXd modes() const {
    std::vector<Eigen::VectorXd> columns;
    for (std::size_t c = 0; c < active.size(); ++c) {
      if (!active[c]) continue;
      const Block& b = system.block[c / kLanes];
      const std::size_t n = b.pattern->n_point;
      Vec3 mean = Vec3::Zero();
      auto at = [&](std::size_t i) {
        return make_address(b.first_row + i, static_cast<int>(c % kLanes));
      };
      for (std::size_t i = 0; i < n; ++i) mean += load_point(position.data(), at(i)) / double(n);
      for (int m = 0; m < (n > 1 ? 6 : 3); ++m) {
        Eigen::VectorXd v = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system.n_dof()));
        for (std::size_t i = 0; i < n; ++i)
          store_point(v.data(), at(i),
                      m < 3 ? Vec3::Unit(m)
                            : Vec3::Unit(m - 3).cross(load_point(position.data(), at(i)) - mean));
        columns.push_back(v);
      }
    }
    Eigen::MatrixXd z(columns[0].size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
      z.col(static_cast<Eigen::Index>(k)) = columns[k];
    return z;
  }
};

/// Cells of three kinds that hold on to the next one only.
JoinedCells make_chain(double medium) {
  CellPairs pairs;
  for (std::size_t c = 0; c + 1 < 3 * kLanes; ++c) pairs.push_back({c, c + 1});
  return {{block_of(kFive), block_of(kSeven), block_of(kSingle)}, pairs, medium, 1};
}

/// Four by four by four cells that hold on to their neighbours.
JoinedCells make_packing(double medium, double hold) {
  CellPairs pairs;
  for (std::size_t c = 0; c < 64; ++c)
    for (const std::size_t stride : {1, 4, 16})
      if (c / stride % 4 != 3) pairs.push_back({c, c + stride});
  return {std::vector(8, block_of(kSeven)), pairs, medium, hold};
}

/// Chebyshev polynomial of the first kind, of any argument.
double chebyshev(int degree, double x) {
  if (std::abs(x) <= 1) return std::cos(degree * std::acos(x));
  return (x < 0 && degree % 2 != 0 ? -1 : 1) * std::cosh(degree * std::acosh(std::abs(x)));
}

/// Matrix of the polynomial, from the eigenvectors of E v = lambda D v. D has the diagonal entries
/// of E: blocks of six rows, or three.
Eigen::MatrixXd polynomial_of(const Eigen::MatrixXd& e, const std::vector<int>& rows_of_cell) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(e.rows(), e.cols());
  int at = 0;
  for (const int n : rows_of_cell) {
    d.block(at, at, n, n) = e.block(at, at, n, n);
    at += n;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(e, d);
  EXPECT_LE(pairs.eigenvalues().maxCoeff(), CoarseSpace::kLargest);
  constexpr double kLow = CoarseSpace::kLargest / CoarseSpace::kSpread,
                   kCenter = 0.5 * (CoarseSpace::kLargest + kLow),
                   kHalf = 0.5 * (CoarseSpace::kLargest - kLow);
  Eigen::VectorXd value(e.rows());
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    const double lambda = pairs.eigenvalues()[k];
    value[k] = (1 - chebyshev(CoarseSpace::kDegree, (kCenter - lambda) / kHalf) /
                        chebyshev(CoarseSpace::kDegree, kCenter / kHalf)) /
               lambda;
  }
  return pairs.eigenvectors() * value.asDiagonal() * pairs.eigenvectors().transpose();
}

TEST(CoarseSpace, IsAChebyshevPolynomialOfTheGalerkinProjection) {
  const JoinedCells c = make_chain(0.1);
  const Eigen::MatrixXd z = c.modes();
  const Eigen::MatrixXd e = z.transpose() * reference::make_dense(c.system) * z;
  const Eigen::MatrixXd p = polynomial_of(e, c.rows_of_cell());
  double worst = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::vector<double> r = random_vector_of<double>(c.system, 71 + seed);
    std::vector<double> found(r.size(), 0.25);  // added to
    const double product = c.coarse.add(r, found);
    const Eigen::VectorXd expected = z * p * z.transpose() * as_eigen(r);
    const Eigen::VectorXd added =
        as_eigen(found) - Eigen::VectorXd::Constant(expected.size(), 0.25);
    worst = std::max(worst, (added - expected).norm() / expected.norm());
    EXPECT_NEAR(product, as_eigen(r).dot(added), 1e-6 * std::abs(product));
  }
  std::printf("coarse part against the dense polynomial %.1e\n", worst);
  EXPECT_LT(worst, 1e-5);  // arms and entries are floats
}

TEST(CoarseSpace, IsSymmetricAndPositiveForAnySystem) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const System s = make_system(80 + seed);
    auto random = reference::stream(90 + seed);
    std::vector<double> position(s.n_dof());
    for (double& x : position) x = random.uniform(-3, 3);
    const std::vector<std::uint8_t> active(s.block.size() * kLanes, 1);
    Operator op;
    op.prepare(s);
    CoarseSpace coarse;
    RowVector<double> mode, product;
    coarse.prepare(op, {position, active, mode, product});
    const auto a = random_vector_of<double>(s, 100 + seed), b = random_vector_of<double>(s, 200);
    std::vector<double> za(a.size()), zb(b.size());
    EXPECT_GT(coarse.add(a, za), 0);
    EXPECT_GT(coarse.add(b, zb), 0);
    EXPECT_NEAR(as_eigen(a).dot(as_eigen(zb)), as_eigen(b).dot(as_eigen(za)),
                1e-12 * as_eigen(a).norm() * as_eigen(zb).norm());
  }
}

TEST(CoarseSpace, SavesIterationsInPackedCells) {
  JoinedCells c = make_packing(1e-6, 0.01);
  CgOptions options;
  options.tolerance = 1e-6;
  const auto rhs = random_vector_of<double>(c.system, 75);
  auto solve = [&](const CoarseSpace* coarse, std::vector<double>& x) {
    CgWorkspace work;
    x.assign(rhs.size(), 0.0);
    const CgResult result = solve_cg({c.op, rhs, coarse}, x, options, work);
    EXPECT_TRUE(result.status.ok) << result.status.cause;
    EXPECT_LE(result.residual, 1e-6);
    return result.iterations;
  };
  std::vector<double> x, with;
  const int plain = solve(nullptr, x), fewer = solve(&c.coarse, with);
  std::printf("packing: %d iterations, %d with the coarse space\n", plain, fewer);
  EXPECT_LT(fewer, 0.75 * plain);
  EXPECT_LT((as_eigen(x) - as_eigen(with)).norm(), 1e-2 * as_eigen(x).norm());
}

TEST(CoarseSpace, SameBitsForAnyNumberOfThreads) {
  const System s = make_system(9, 80);
  auto random = reference::stream(91);
  std::vector<double> position(s.n_dof());
  for (double& x : position) x = random.uniform(-3, 3);
  const std::vector<std::uint8_t> active(s.block.size() * kLanes, 1);
  const auto r = random_vector_of<float>(s, 92);
  const int before = thread_count();
  std::vector<std::vector<float>> seen;
  for (int threads : {1, 2, 3}) {
    set_threads(threads);
    Operator op;
    op.prepare(s);
    CoarseSpace coarse;
    RowVector<double> mode, product;
    coarse.prepare(op, {position, active, mode, product});
    std::vector<float> z(r.size());
    coarse.add(r, z);
    seen.push_back(z);
  }
  set_threads(before);
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
}

}  // namespace
}  // namespace acinus::solve
