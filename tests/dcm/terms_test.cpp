/// Properties of every term of the deformable cell: gradient, balance, invariance, semi-definite
/// matrix.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdio>

#include "dcm/lane_data.hpp"
#include "dcm/loads/loads.hpp"
#include "dcm/mesh_pattern.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

class EveryTerm : public testing::TestWithParam<Term> {
 protected:
  const Params params_ = table_one();
  void add(Cells& c) const { GetParam().add(params_, c.view(), c.system); }
  double energy(const Cells& c, std::size_t lane) const {
    return GetParam().energy(params_, c.view(), static_cast<int>(lane));
  }
};

TEST_P(EveryTerm, EnergyIsThatOfThePlainTwin) {
  const Cells c = make_deformed_cells();
  double worst = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    const double plain = GetParam().plain(params_, c.plain(l));
    EXPECT_GT(plain, 0);
    worst = std::max(worst, std::abs(energy(c, l) - plain) / plain);
  }
  std::printf("%s: energy against plain twin %.1e\n", GetParam().name, worst);
  // V ln(V/V0) - V + V0 and 1 - cos lose what the strain squared is below 1: at most four digits.
  EXPECT_LT(worst, 1e4 * 64 * kEps);
}

TEST_P(EveryTerm, ForceIsMinusEnergyGradient) {
  Cells c = make_deformed_cells(42);
  add(c);
  double worst = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    const double scale = c.largest_force(l);
    EXPECT_GT(scale, 0);
    worst = std::max(worst, worst_slope_error(c, l, [&] { return energy(c, l); }) / scale);
  }
  std::printf("%s: force against differences %.1e of the largest\n", GetParam().name, worst);
  EXPECT_LT(worst, 1e-6);
}

TEST_P(EveryTerm, NetForceAndTorqueVanish) {
  Cells c = make_deformed_cells();
  add(c);
  double worst = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    const reference::NetForce net = c.net_force(l);
    worst = std::max({worst, net.force_share(), net.torque_share()});
  }
  std::printf("%s: net force and torque %.1e of the sum\n", GetParam().name, worst);
  EXPECT_LT(worst, 64 * kEps);
}

TEST_P(EveryTerm, TurnsWithTheCell) {
  Cells c = make_deformed_cells();
  add(c);
  Cells turned = make_deformed_cells();
  auto random = reference::stream(2);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 20);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) turned.move(l, i, q * c.node(l, i) + shift);
  add(turned);
  double worst = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    const double scale = c.largest_force(l);
    for (int i = 0; i < c.n_node(); ++i)
      worst = std::max(worst, (turned.force(l, i) - q * c.force(l, i)).norm() / scale);
    EXPECT_NEAR(energy(turned, l), energy(c, l), 1e-10 * energy(c, l));
  }
  std::printf("%s: rotation %.1e of the largest force\n", GetParam().name, worst);
  // Coordinates near 40 um, edges near 2 um strained by a tenth: 1e3 kEps; a margin of ten.
  EXPECT_LT(worst, 1e4 * kEps);
}

TEST_P(EveryTerm, EmptyLaneGetsNothing) {
  Cells c = make_deformed_cells();
  add(c);
  EXPECT_EQ(c.largest_force(kNoCell), 0);
  EXPECT_EQ(energy(c, kNoCell), 0);
  for (const auto& rank_one : c.system.rank_one) EXPECT_EQ(rank_one.coefficient[kNoCell], 0);
  for (const auto* g : {&c.system.spring, &c.system.hinge, &c.system.face})
    for (std::size_t k = kNoCell; k < g->size(); k += kLanes) ASSERT_EQ((*g)[k], 0);
}

TEST_P(EveryTerm, StiffnessIsSymmetricAndSemiDefinite) {
  Cells c = make_deformed_cells();
  add(c);
  const auto matrices = lane_matrices(c);
  for (std::size_t l : {std::size_t{0}, std::size_t{6}}) {
    const Eigen::MatrixXd& k = matrices[l];
    const double scale = k.cwiseAbs().maxCoeff();
    EXPECT_GT(scale, 0);
    EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 16 * kEps * scale);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    std::printf("%s lane %zu: eigenvalues %.1e .. %.3e nN/um\n", GetParam().name, l,
                values.minCoeff(), values.maxCoeff());
    EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff());
  }
}

// Elements see differences only; the whole-cell gradients add up to zero but for round-off.
TEST_P(EveryTerm, MatrixIsBlindToTranslation) {
  Cells c = make_deformed_cells();
  add(c);
  solve::Operator op;
  op.prepare(c.system);
  std::vector<double> x(c.system.n_dof()), y(x.size());
  for (std::size_t row = 0; row < c.system.n_row; ++row)
    for (int l = 0; l < kLanes; ++l) store_point(x.data(), make_address(row, l), Vec3(0.3, -2, 7));
  op.apply(x, y);
  double pull = 0, family = 0;
  for (double v : y) pull = std::max(pull, std::abs(v));
  for (const solve::RankOne& r : c.system.rank_one) {
    double most = 0;
    for (float g : r.vector) most = std::max(most, std::abs(static_cast<double>(g)));
    for (double k : r.coefficient) family = std::max(family, k * most * most * 7 * c.n_node());
  }
  std::printf("%s: force of a translation %.1e nN\n", GetParam().name, pull);
  EXPECT_LE(pull, 64 * kEps * family);  // exactly zero without a family
}

/// -dF/dx of one lane by differences, um steps h.
Eigen::MatrixXd force_differences(Cells& c, const Term& term, const Params& p, std::size_t lane) {
  const int n = 3 * c.n_node();
  Eigen::MatrixXd k(n, n);
  const double h = 1e-4;
  const auto forces = [&] {
    solve::clear_loads(c.system);
    term.add(p, c.view(), c.system);
    Eigen::VectorXd f(n);
    for (int i = 0; i < c.n_node(); ++i) f.segment<3>(3 * i) = c.force(lane, i);
    return f;
  };
  for (int column = 0; column < n; ++column) {
    const Vec3 x = c.node(lane, column / 3), step = h * Vec3::Unit(column % 3);
    c.move(lane, column / 3, x + step);
    const Eigen::VectorXd more = forces();
    c.move(lane, column / 3, x - step);
    k.col(column) = (forces() - more) / (2 * h);
    c.move(lane, column / 3, x);
  }
  solve::clear_loads(c.system);
  return k;
}

// At rest every dropped piece is multiplied by zero, so the matrix is the true Hessian there.
TEST_P(EveryTerm, StiffnessIsTheHessianAtRest) {
  Cells c = make_rest_cells(geometry::shared_icosphere(42), {8, 9, 10});
  const Eigen::MatrixXd differences = force_differences(c, GetParam(), params_, 1);
  add(c);
  const Eigen::MatrixXd k = lane_matrices(c)[1];
  const double worst = (k - differences).cwiseAbs().maxCoeff() / k.cwiseAbs().maxCoeff();
  std::printf("%s: Hessian at rest against differences %.1e\n", GetParam().name, worst);
  EXPECT_LT(worst, 2e-7);  // elements and shapes are floats
}

TEST_P(EveryTerm, RestShapeOfAnyRadiusHasNoForce) {
  const std::vector<double> radii{1, 3, 8.8, 12, 15.119, 24, 40, 120};
  Cells c = make_rest_cells(geometry::shared_icosphere(162), radii);
  add(c);
  Cells rough = make_rest_cells(geometry::shared_icosphere(162), radii);
  auto random = reference::stream(4);
  for (std::size_t l = 0; l < kLanes; ++l)  // what a 1 % wrong size and shape costs
    for (int i = 0; i < c.n_node(); ++i)
      rough.move(l, i,
                 1.01 * rough.node(l, i) + reference::random_vector(random, 0.003 * radii[l]));
  add(rough);
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_LT(c.largest_force(l), 100 * kEps * rough.largest_force(l) / 0.01) << radii[l];
    // 1 - cos theta0 rounds: kEps per hinge; the others square a strain of kEps.
    EXPECT_LT(std::abs(energy(c, l)),
              1e4 * kEps * (1 + params_.bulk_modulus * radii[l] * radii[l] * radii[l]));
  }
}

INSTANTIATE_TEST_SUITE_P(Dcm, EveryTerm, testing::ValuesIn(all_terms()),
                         [](const auto& term) { return std::string(term.param.name); });

TEST(Cortex, StiffnessOfATautCellIsTheHessian) {
  Params p = params_without_terms();
  p.spring_stiffness = 0.433;
  Cells c = make_rest_cells(geometry::shared_icosphere(42), {8, 9, 10});
  auto random = reference::stream(3);
  for (int i = 0; i < c.n_node(); ++i)  // every edge at least 5 % longer than at rest
    c.move(1, i, 1.15 * c.node(1, i) + reference::random_vector(random, 0.1));
  const Eigen::MatrixXd differences = force_differences(c, all_terms()[0], p, 1);
  add_cortex(p, c.view(), c.system);
  const Eigen::MatrixXd k = lane_matrices(c)[1];
  const double worst = (k - differences).cwiseAbs().maxCoeff() / k.cwiseAbs().maxCoeff();
  std::printf("taut cortex: Hessian against differences %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);  // elements are floats
}

// A step is stable where the matrix is at least half the true derivative: a tense membrane resists
// short waves of the surface, which the rank-one part alone does not see (decision 7).
TEST(Area, MatrixHoldsATautSurface) {
  Cells c = make_rest_cells(geometry::shared_icosphere(42), {8, 9, 10});
  auto random = reference::stream(5);
  for (int i = 0; i < c.n_node(); ++i)
    c.move(1, i, 1.05 * c.node(1, i) + reference::random_vector(random, 0.1));
  const Params p = table_one();
  const Term& area = all_terms()[3];
  const Eigen::MatrixXd differences = force_differences(c, area, p, 1);
  area.add(p, c.view(), c.system);
  const Eigen::MatrixXd k = lane_matrices(c)[1];
  const Eigen::MatrixXd j = (differences + differences.transpose()) / 2;
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  const double worst = Solver(j - 2 * k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  const double scale = Solver(j, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  std::printf("taut membrane: J - 2 K at most %.1e, J at most %.3f nN/um\n", worst, scale);
  EXPECT_LT(worst, 1e-8 * scale);
}

// Explicit steps ask for friction alone.
TEST(Terms, StiffnessScaleSwitchesTheMatrixOff) {
  Cells c = make_deformed_cells(42);
  c.system.stiffness_scale = 0;
  for (const Term& term : all_terms()) term.add(table_one(), c.view(), c.system);
  for (const auto* g : {&c.system.spring, &c.system.hinge, &c.system.face})
    for (float v : *g) ASSERT_EQ(v, 0);
  for (const auto& family : c.system.rank_one)
    for (double k : family.coefficient) ASSERT_EQ(k, 0);
  EXPECT_GT(c.largest_force(0), 0);
}

TEST(MeshPattern, HasTheElementsThatTermsUse) {
  const geometry::Topology& t = geometry::shared_icosphere(42);
  for (double bending : {0.0, 0.01})
    for (double area : {0.0, 0.8}) {
      Params p = params_without_terms();
      p.bending_stiffness = bending;
      p.local_area_modulus = area;
      const solve::BlockPattern& pattern = shared_mesh_pattern(t, p);
      EXPECT_EQ(&pattern, &shared_mesh_pattern(t, p)) << "made once";
      EXPECT_EQ(pattern.n_point, 42);
      EXPECT_EQ(pattern.spring, t.edge);
      EXPECT_EQ(pattern.wing.size(), bending > 0 ? t.edge.size() : 0u);
      EXPECT_EQ(pattern.face, area > 0 ? t.triangle : decltype(t.triangle){});
      for (std::size_t e = 0; e < pattern.wing.size(); ++e) {
        EXPECT_EQ(pattern.wing[e], (std::array<int, 2>{t.hinge[e][0], t.hinge[e][1]}));
        // the sweep over hinges takes their other two points from the spring
        EXPECT_EQ(t.edge[e], (std::array<int, 2>{t.hinge[e][2], t.hinge[e][3]}));
      }
      Cells c = make_rest_cells(t, {8, 9});
      solve::set_blocks(c.system, make_blocks(c.state, std::span(&p, 1)));
      EXPECT_EQ(c.system.spring.size(), t.edge.size() * solve::kSpringStride);
      EXPECT_EQ(c.system.hinge.empty(), bending == 0);
      EXPECT_EQ(c.system.shape.size(), 42u * kPointStride);
      EXPECT_EQ(c.system.face.empty(), area == 0);
    }
  EXPECT_NE(&shared_mesh_pattern(t, params_without_terms()),
            &shared_mesh_pattern(geometry::shared_icosphere(162), params_without_terms()));
}

// Two types in one system: one with hinges only, one with faces only. Offsets must not run
// together.
TEST(Terms, TypesWithDifferentElementsShareASystem) {
  Params type[2] = {table_one(), table_one()};
  type[0].local_area_modulus = 0;
  type[1].bending_stiffness = 0;
  const geometry::Topology& t = geometry::shared_icosphere(42);
  std::vector<NewCell> cells(3);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    cells[k].lineage = static_cast<std::int64_t>(k);
    cells[k].type = k == 1 ? 0 : 1;
    cells[k].topology = &t;
    cells[k].radius = 8 + static_cast<double>(k);
    cells[k].center = Vec3(30.0 * static_cast<double>(k), 0, 0);
  }
  auto random = reference::stream(6);
  const auto loads_of = [](State& state, std::span<const Params> params) {
    Cells c;
    c.state = state;
    c.lanes = make_lane_data(c.state, 0);
    solve::set_blocks(c.system, make_blocks(c.state, params));
    size_rank_one(c.state, params, c.system);
    solve::clear_loads(c.system);
    const std::vector<double> free_area(c.state.n_row() * kLanes, 0.01);
    const std::vector<Vec3> cell_force(c.state.n_lane(), Vec3::Zero());
    add_loads(c.state, params, c.lanes, free_area, cell_force, c.system);
    return c;
  };
  State both = make_state(cells);
  for (double& x : both.position) x += random.uniform(-0.2, 0.2);
  const Cells together = loads_of(both, type);
  std::vector<double> x(together.system.n_dof()), y(x.size());
  for (double& v : x) v = random.uniform(-1, 1);
  solve::Operator op;
  op.prepare(together.system);
  op.apply(x, y);
  // Each group again, in a system of its own.
  for (std::size_t g = 0; g < both.group.size(); ++g) {
    State one = both;
    one.group = {both.group[g]};
    one.group[0].first_row = 0;
    const auto cut = [&](auto& v, std::size_t per_group) {
      const auto first = v.begin() + static_cast<std::ptrdiff_t>(g * per_group);
      const std::vector kept(first, first + static_cast<std::ptrdiff_t>(per_group));
      v.assign(kept.begin(), kept.end());
    };
    const std::size_t n = static_cast<std::size_t>(t.n_node) * kPointStride;
    cut(one.position, n);
    cut(one.lineage, kLanes);
    cut(one.volume, kLanes);
    cut(one.pull, kLanes);
    Cells alone = loads_of(one, type);
    std::vector<double> in = x, out(n);
    cut(in, n);
    op.prepare(alone.system);
    op.apply(in, out);
    for (std::size_t k = 0; k < n; ++k) {
      ASSERT_EQ(out[k], y[g * n + k]);
      ASSERT_EQ(alone.system.force[k], together.system.force[g * n + k]);
    }
  }
  EXPECT_EQ(both.group.size(), 2u);
  EXPECT_EQ(together.system.hinge.size(), t.edge.size() * solve::kHingeStride);
  EXPECT_EQ(together.system.face.size(), t.triangle.size() * solve::kFaceStride);
}

TEST(Terms, SumOfLoadsIsTheSumOfTerms) {
  Cells c = make_deformed_cells(42);
  const Params p = table_one();
  for (const Term& term : all_terms()) term.add(p, c.view(), c.system);
  const auto apart = c.system.force;
  c.reset();
  const std::vector<double> free_area(c.state.n_row() * kLanes, 0.0);
  const std::vector<Vec3> cell_force(c.state.n_lane(), Vec3(1, 2, 3));
  add_loads(c.state, std::span(&p, 1), c.lanes, free_area, cell_force, c.system);
  double scale = 0, worst = 0;
  for (std::size_t k = 0; k < apart.size(); ++k) {
    scale = std::max(scale, std::abs(apart[k]));
    worst = std::max(worst, std::abs(apart[k] - c.system.force[k]));
  }
  EXPECT_LT(worst, 64 * kEps * scale);
  Vec3 total = Vec3::Zero();
  for (int i = 0; i < c.n_node(); ++i)
    total += load_point(c.system.external_force.data(), node_address(c.state, 0, i));
  EXPECT_LT((total - Vec3(1, 2, 3)).norm(), 64 * kEps * 4);
  EXPECT_EQ(
      skipped_terms(std::span(&p, 1)),
      (std::vector<std::string>{"viscosity of the cortex", "dashpots in series with the cortex",
                                "active tension of the cortex", "nuclei"}));
}

}  // namespace
}  // namespace acinus::dcm
