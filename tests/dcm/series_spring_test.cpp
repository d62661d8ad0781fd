/// Springs in series with dashpots: one element against its closed forms, then what every term
/// owes.

#include "dcm/terms/series_spring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "dcm/tensions.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

// One element: spring k and dashpot g in series, a dashpot eta beside both.
constexpr double kSpring = 0.5, kSeries = 3, kBeside = 0.03;  // nN/um, nN s/um: 6 s, 0.06 s

TEST(SeriesSpring, RelaxationAndConstantRateAreExactForAnyStep) {
  for (const double step : {1e-6, 0.01, 0.3, 6.0, 60.0, 1e4}) {
    const double tau = kSeries / kSpring, rate = 0.02;
    const SeriesStep h = series_step(kSpring, kSeries, step);
    EXPECT_NEAR(h.kept, std::exp(-step / tau), 1e-15);
    // From rest at a constant rate: f = g v (1 - exp(-t / tau)).
    EXPECT_NEAR(h.share * kSpring * rate * step, kSeries * rate * -std::expm1(-step / tau),
                1e-15 * kSeries);
  }
  EXPECT_EQ(series_step(kSpring, kSeries, 0).share, 1);
}

/// Length gained by the element under a constant force after `end`, in steps as the solver takes
/// them: (eta/h + share k) dx = F - kept f.
double creep(double force, double end, int steps) {
  const double h = end / steps;
  const SeriesStep s = series_step(kSpring, kSeries, h);
  double x = 0, f = 0;
  for (int k = 0; k < steps; ++k) {
    const double dx = (force - s.kept * f) / (kBeside / h + s.share * kSpring);
    f = s.kept * f + s.share * kSpring * dx;
    x += dx;
  }
  return x;
}

// F = eta dx/dt + f, (df/dt) / k + f / g = dx/dt: the rate falls from F / eta to F / (eta + g) with
// the time eta g / (k (eta + g)).
TEST(SeriesSpring, CreepConvergesAtFirstOrder) {
  const double force = 0.2, end = 2, tau = kBeside * kSeries / (kSpring * (kBeside + kSeries));
  const double slow = force / (kBeside + kSeries), fast = force / kBeside - slow;
  const double exact = slow * end + fast * tau * -std::expm1(-end / tau);
  double before = 0;
  for (int steps = 50; steps <= 1600; steps *= 2) {
    const double error = std::abs(creep(force, end, steps) / exact - 1);
    std::printf("creep in %4d steps: error %.2e\n", steps, error);
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 1, 0.2);
    }
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

Params series_params() {
  Params p = table_one();
  p.series_friction = 3;
  p.nodal_friction = 0;
  return p;
}

/// Deformed cells whose edges are under tensions of either sign, from lengths a tenth off those of
/// now.
Cells make_tense_cells(int n_node = 162) {
  Cells c = make_deformed_cells(n_node);
  auto random = reference::stream(11);
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    EdgeTension& t = c.state.tension[l];
    for (std::size_t e = 0; e < c.state.group[0].topology->edge.size(); ++e) {
      t.force.push_back(random.uniform(-0.1, 0.2));
      t.length.push_back(edge_length(c.state, l, e) * random.uniform(0.9, 1.1));
    }
  }
  c.reset();
  c.system.friction_scale = 1 / 2.0;  // steps of 2 s
  return c;
}

/// Energy whose gradient is the force of a step: sum of kept f l + 1/2 share k (l - l0)^2 over
/// edges.
double step_energy(const Cells& c, const Params& p, std::size_t lane) {
  const SeriesStep h =
      series_step(p.spring_stiffness, p.series_friction, 1 / c.system.friction_scale);
  const EdgeTension& t = c.state.tension[lane];
  double energy = 0;
  for (std::size_t e = 0; e < t.force.size(); ++e) {
    const double length = edge_length(c.state, lane, e), change = length - t.length[e];
    energy += h.kept * t.force[e] * length + 0.5 * h.share * p.spring_stiffness * change * change;
  }
  return energy;
}

TEST(SeriesSpring, ForceIsMinusTheGradientOfTheStepsEnergy) {
  const Params p = series_params();
  Cells c = make_tense_cells(42);
  add_series_springs(p, c.view(), c.system);
  double worst = 0, scale = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    scale = std::max(scale, c.largest_force(l));
    worst = std::max(worst, worst_slope_error(c, l, [&] { return step_energy(c, p, l); }));
  }
  std::printf("force against differences: %.1e of the largest\n", worst / scale);
  EXPECT_LT(worst, 1e-6 * scale);
}

TEST(SeriesSpring, BalancesAndTurnsWithTheCell) {
  const Params p = series_params();
  Cells c = make_tense_cells(), turned = make_tense_cells();
  add_series_springs(p, c.view(), c.system);
  auto random = reference::stream(12);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 20);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) turned.move(l, i, q * c.node(l, i) + shift);
  add_series_springs(p, turned.view(), turned.system);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const reference::NetForce net = c.net_force(l);
    if (l == kNoCell) {
      EXPECT_EQ(net.force_sizes, 0);
      continue;
    }
    EXPECT_LT(net.force.norm(), 64 * kEps * net.force_sizes);
    EXPECT_LT(net.torque.norm(), 64 * kEps * 20 * net.force_sizes);
    const double largest = c.largest_force(l);
    for (int i = 0; i < c.n_node(); ++i)
      EXPECT_LT((turned.force(l, i) - q * c.force(l, i)).norm(), 1e4 * kEps * largest);
  }
}

TEST(SeriesSpring, StiffnessIsSymmetricAndSemiDefinite) {
  const Params p = series_params();
  Cells c = make_tense_cells(42);
  add_series_springs(p, c.view(), c.system);
  const auto matrices = lane_matrices(c);
  const Eigen::MatrixXd& k = matrices[0];
  EXPECT_GT(k.cwiseAbs().maxCoeff(), 0);
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 16 * kEps * k.cwiseAbs().maxCoeff());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff());
}

// Without motion the tension falls by exp(-t/tau), and the springs' energy with it: what is gone is
// what the dashpots took, f^2/g over time.
TEST(SeriesSpring, TensionAtRestDecaysIntoHeat) {
  const std::vector<Params> params{series_params()};
  const Params& p = params[0];
  Cells c = make_tense_cells();
  for (EdgeTension& t : c.state.tension)
    for (std::size_t e = 0; e < t.force.size(); ++e)
      t.length[e] = edge_length(c.state, &t - c.state.tension.data(), e);
  c.reset();
  const double before = series_spring_energy(p, c.view(), 0);
  const std::vector<double> at_start = c.state.tension[0].force;
  double heat = 0;
  constexpr int kSteps = 2000;
  constexpr double kStep = 5e-3;  // s
  for (int k = 0; k < kSteps; ++k) {
    double power = 0;
    for (const double f : c.state.tension[0].force) power += f * f / p.series_friction;
    advance_tensions(params, kStep, c.state);
    for (const double f : c.state.tension[0].force) power += f * f / p.series_friction;
    heat += 0.5 * power * kStep;
  }
  c.reset();
  const double tau = p.series_friction / p.spring_stiffness;
  EXPECT_NEAR(c.state.tension[0].force[7], at_start[7] * std::exp(-kSteps * kStep / tau), 1e-12);
  EXPECT_NEAR(before - series_spring_energy(p, c.view(), 0), heat, 1e-5 * before);
}

TEST(SeriesSpring, NewCellsBeginWithoutTension) {
  const std::vector<Params> params{series_params()};
  Cells c = make_deformed_cells();
  add_series_springs(params[0], c.view(), c.system);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) EXPECT_EQ(c.force(l, i).norm(), 0);
  begin_tensions(params, c.state);
  EXPECT_TRUE(c.state.tension[kNoCell].is_new());
  EXPECT_EQ(mean_tension(c.state.tension[0]), 0);
  EXPECT_EQ(c.state.tension[0].length[5], edge_length(c.state, 0, 5));
}

}  // namespace
}  // namespace acinus::dcm
