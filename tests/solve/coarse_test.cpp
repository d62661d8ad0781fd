#include "solve/coarse.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdio>

#include "core/parallel/threads.hpp"
#include "solve/cg.hpp"
#include "tests/solve/systems.hpp"

namespace acinus::solve {
namespace {

/// Cells that hold on to the next one only: the factor of their coarse matrix has no fill, so the
/// incomplete one is exact.
struct Chain {
  System system;
  std::vector<double> position;
  std::vector<std::uint8_t> active;
  Operator op;
  CoarseSpace coarse;

  explicit Chain(double medium) {
    auto random = reference::stream(70);
    system.friction_scale = 0.5;
    set_blocks(system, {block_of(kFive), block_of(kSeven), block_of(kSingle)});
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
    for (std::size_t c = 0; c + 1 < active.size(); ++c) {
      if (!active[c] || !active[c + 1]) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        Link link;
        link.a = c < 2 * kLanes
                     ? Side{{point_of(c, k), point_of(c, k + 1), point_of(c, k + 2)}, {0.25f, 0.5f}}
                     : Side::at(point_of(c, 0));
        link.b = Side::at(point_of(c + 1, k));
        const Vec3 normal = random.unit_vector();
        const double friction = random.uniform(1, 3), stiffness = random.uniform(1, 3);
        set_law(stiffness, friction, 0, normal, link);
        system.links.link.push_back(link);
        system.links.law.emplace_back();
      }
    }
    op.prepare(system);
    coarse.prepare(op, position, active);
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

TEST(CoarseSpace, IsTheGalerkinProjectionWhereNothingFillsIn) {
  Chain c(0.1);
  const Eigen::MatrixXd z = c.modes();
  const Eigen::MatrixXd e = z.transpose() * reference::make_dense(c.system) * z;
  double worst = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::vector<double> r = random_vector_of<double>(c.system, 71 + seed);
    std::vector<double> found(r.size(), 0.25);  // added to
    const double product = c.coarse.add(r, found);
    const Eigen::VectorXd expected = z * e.ldlt().solve(z.transpose() * as_eigen(r));
    const Eigen::VectorXd added =
        as_eigen(found) - Eigen::VectorXd::Constant(expected.size(), 0.25);
    worst = std::max(worst, (added - expected).norm() / expected.norm());
    EXPECT_NEAR(product, as_eigen(r).dot(added), 1e-6 * std::abs(product));
  }
  std::printf("coarse part against the dense projection %.1e\n", worst);
  EXPECT_LT(worst, 1e-5);  // arms are floats, and E is as ill-conditioned as the chain is long
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
    coarse.prepare(op, position, active);
    const auto a = random_vector_of<double>(s, 100 + seed), b = random_vector_of<double>(s, 200);
    std::vector<double> za(a.size()), zb(b.size());
    EXPECT_GT(coarse.add(a, za), 0);
    EXPECT_GT(coarse.add(b, zb), 0);
    EXPECT_NEAR(as_eigen(a).dot(as_eigen(zb)), as_eigen(b).dot(as_eigen(za)),
                1e-12 * as_eigen(a).norm() * as_eigen(zb).norm());
  }
}

TEST(CoarseSpace, SavesIterationsOnALooseChain) {
  Chain c(1e-4);
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
  std::printf("chain: %d iterations, %d with the coarse space\n", plain, fewer);
  EXPECT_LT(fewer, plain / 2);
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
    coarse.prepare(op, position, active);
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
