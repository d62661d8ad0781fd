/// Three ways to take a step, on one stretched cell that relaxes in a liquid.

#include "coupling/step/controller.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "dcm/tensions.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

constexpr double kEnd = 0.064;   ///< s, a part of the slow modes' relaxation
constexpr double kStep = 0.002;  ///< s, below the limit of explicit Euler

/// One cell of 42 nodes, stretched by 10 % along one axis and compressed along the others so that
/// the volume stays.
World stretched_cell(Integrator integrator, double step) {
  World w = make_test_world({{Vec3(1, 2, 3)}}, step, 42);
  w.params.dcm[0].viscosity = 1e-6;
  w.params.numerics.min_step = step;
  w.params.numerics.tolerance = 1e-7;  // Newton stops at a tenth of it
  w.params.numerics.cg = {1e-10, 20000};
  w.params.numerics.integrator = integrator;
  const Mat3 turn = Eigen::AngleAxisd(0.6, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const Vec3 factor(1.1, 1 / std::sqrt(1.1), 1 / std::sqrt(1.1));
  const Mat3 stretch = turn * factor.asDiagonal() * turn.transpose();
  const Vec3 center = dcm::cell_center(w.state.dcm, 0);
  for (int i = 0; i < 42; ++i) {
    const Address a = dcm::node_address(w.state.dcm, 0, i);
    double* const x = w.state.dcm.position.data();
    store_point(x, a, center + stretch * (load_point(x, a) - center));
  }
  return w;
}

std::vector<Vec3> nodes_of(const World& w) {
  std::vector<Vec3> node;
  dcm::copy_nodes(w.state.dcm, 0, node);
  return node;
}

std::vector<Vec3> relaxed(Integrator integrator, double step, double end = kEnd) {
  World w = stretched_cell(integrator, step);
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, end)) << name_of(integrator);
  return nodes_of(w);
}

/// End of a run with kStep halved so many times; every run is made once.
const std::vector<Vec3>& end_of(Integrator integrator, int halvings) {
  static std::map<std::pair<Integrator, int>, std::vector<Vec3>> ends;
  std::vector<Vec3>& end = ends[{integrator, halvings}];
  if (end.empty()) end = relaxed(integrator, std::ldexp(kStep, -halvings));
  return end;
}

/// Limit of small steps, by Richardson extrapolation: its error is of second order.
std::vector<Vec3> limit_of(Integrator integrator) {
  std::vector<Vec3> limit = end_of(integrator, 4);
  const std::vector<Vec3>& coarse = end_of(integrator, 3);
  for (std::size_t k = 0; k < limit.size(); ++k) limit[k] += limit[k] - coarse[k];
  return limit;
}

double distance(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - y[k]).squaredNorm();
  return std::sqrt(sum);
}

/// Edge lengths do not see where a cell is and how it is turned.
double largest_edge_difference(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  double largest = 0;
  for (const auto& t : geometry::shared_icosphere(42).triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = t[k], j = t[(k + 1) % 3];
      largest = std::max(largest, std::abs((x[i] - x[j]).norm() - (y[i] - y[j]).norm()));
    }
  return largest;
}

bool all_finite(const World& w) {
  return std::ranges::all_of(w.state.dcm.position, [](double x) { return std::isfinite(x); });
}

TEST(Integrators, HaveTheNamesOfTheScene) {
  EXPECT_EQ(name_of(Integrator::kLinearlyImplicit), "linearly-implicit");
  EXPECT_EQ(name_of(Integrator::kExplicitEuler), "explicit-euler");
  EXPECT_EQ(name_of(Integrator::kNewton), "newton");
}

class Order : public testing::TestWithParam<std::pair<Integrator, double>> {};

TEST_P(Order, IsAsStatedByHalvings) {
  const auto [integrator, order] = GetParam();
  const auto &a = end_of(integrator, 0), &b = end_of(integrator, 1), &c = end_of(integrator, 2),
             &d = end_of(integrator, 3);
  const double coarse = std::log2(distance(a, b) / distance(b, c)),
               fine = std::log2(distance(b, c) / distance(c, d));
  std::printf("%s: order %.3f, then %.3f; last difference %.2e um\n", name_of(integrator).c_str(),
              coarse, fine, distance(c, d));
  EXPECT_NEAR(fine, order, 0.1 * order);
}

TEST_P(Order, ApproachesTheSameSolutionAsTheOthers) {
  const std::vector<Vec3> exact = limit_of(Integrator::kNewton);
  const auto [integrator, order] = GetParam();
  const double coarse = distance(end_of(integrator, 1), exact),
               fine = distance(end_of(integrator, 2), exact);
  std::printf("%s: %.2e um, then %.2e um from the limit, order %.3f\n", name_of(integrator).c_str(),
              coarse, fine, std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.1 * order);
  EXPECT_LT(fine, 0.02 * distance(exact, nodes_of(stretched_cell(integrator, 1))));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Order,
                         testing::Values(std::pair(Integrator::kLinearlyImplicit, 1.0),
                                         std::pair(Integrator::kExplicitEuler, 1.0),
                                         std::pair(Integrator::kNewton, 1.0)));

/// Stretched cell with springs in series with dashpots, released: the edges were stretched for so
/// long a time that half of their tension is there.
std::vector<Vec3> flowed(Integrator integrator, double step) {
  World w = stretched_cell(integrator, step);
  w.params.dcm[0].series_friction = 0.05;
  const geometry::Topology& t = geometry::shared_icosphere(42);
  dcm::EdgeTension& tension = w.state.dcm.tension[0];
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    const double length = dcm::edge_length(w.state.dcm, 0, e);
    tension.length.push_back(length);
    tension.force.push_back(0.5 * w.params.dcm[0].spring_stiffness *
                            (length - 12 * t.rest_length[e]));
  }
  SizedWorkspace work(w);
  EXPECT_TRUE(run_until(w, work, kEnd)) << name_of(integrator);
  return nodes_of(w);
}

TEST(SeriesDashpots, EveryIntegratorFollowsThemAtFirstOrder) {
  const std::vector<Vec3> fine = flowed(Integrator::kNewton, std::ldexp(kStep, -7));
  for (const Integrator i :
       {Integrator::kLinearlyImplicit, Integrator::kExplicitEuler, Integrator::kNewton}) {
    double before = 0;
    for (int halvings = 0; halvings < 4; ++halvings) {
      const double error = distance(flowed(i, std::ldexp(kStep, -halvings)), fine);
      std::printf("%s, step %.2e s: %.2e um\n", name_of(i).c_str(), std::ldexp(kStep, -halvings),
                  error);
      if (before > 0) {
        EXPECT_NEAR(std::log2(before / error), 1, 0.25) << name_of(i);
      }
      before = error;
    }
  }
}

TEST(ExplicitEuler, IsToldAboveItsStabilityLimit) {
  for (const double step : {0.016, 0.02, 0.1, 1.0, 1e3, 1e300}) {
    World w = stretched_cell(Integrator::kExplicitEuler, step);
    SizedWorkspace work(w);
    StepResult result;
    std::uint64_t before = 0;
    int accepted = 0;
    for (int k = 0; k < 500; ++k) {
      before = hash_state(w.state);
      result = take_step(w, work, step);
      ASSERT_TRUE(all_finite(w)) << "step " << step << " after " << k << " steps";
      if (!result.accepted) break;
      ++accepted;
    }
    std::printf("explicit Euler, steps of %.2g s: %d accepted, then \"%s\"\n", step, accepted,
                result.cause.c_str());
    EXPECT_FALSE(result.accepted) << step;
    EXPECT_FALSE(result.cause.empty());
    EXPECT_EQ(hash_state(w.state), before) << "a rejected step left a trace";
  }
}

TEST(ExplicitEuler, RejectedStepsAreTriedAgainHalfAsLong) {
  World w = stretched_cell(Integrator::kExplicitEuler, 1000);
  w.params.numerics.min_step = 1e-4;
  SizedWorkspace work(w);
  const StepResult result = take_step(w, work, 1000);
  std::printf("explicit Euler: %d rejections from 1000 s to %.3g s\n", result.rejections,
              result.step);
  EXPECT_TRUE(result.accepted) << result.cause;
  EXPECT_GT(result.rejections, 0);
  EXPECT_EQ(result.step, std::ldexp(1000.0, -result.rejections));
  EXPECT_TRUE(all_finite(w));
}

/// Retries of a solve that needs more iterations than it may take: a shorter step does not help;
/// the second attempt may take twice as many, the third four times.
TEST(LinearlyImplicit, ASolveThatFailsGetsMoreIterations) {
  World w = make_test_world(
      {{Vec3(0, 0, 0), true, Vec3(0, 0, -3)}, {Vec3(0, 0, 23), true, Vec3::Zero()}}, 60, 162);
  w.params.numerics.cg = {1e-8, 12};
  SizedWorkspace work(w);
  const StepResult step = take_step(w, work, 60);
  std::printf("%d rejections\n", step.rejections);
  EXPECT_TRUE(step.accepted);
  EXPECT_GE(step.rejections, 1);
  EXPECT_LE(step.rejections, 6);
  EXPECT_EQ(work.failed_solves, step.rejections);
}

TEST(Newton, SolvesBackwardEuler) {
  for (const double step : {0.01, 1.0, 100.0}) {
    const World start = stretched_cell(Integrator::kNewton, step);
    World w = start;
    Workspace work, at;
    size_workspace(w, work);
    const StepResult result = take_step(w, work, step);
    ASSERT_TRUE(result.accepted) << result.cause;

    // Gamma/h of the start on the displacement, against the forces of the end.
    const std::size_t n = w.state.dcm.position.size();
    std::vector<double> moved(n), drag(n);
    for (std::size_t k = 0; k < n; ++k)
      moved[k] = w.state.dcm.position[k] - start.state.dcm.position[k];
    size_workspace(start, at);
    assemble(start, step, at);
    const auto first_force = at.system.force;
    assemble(start, step, at, {.stiffness = false});
    at.op.apply(moved, drag);
    assemble(w, step, at);
    double residual = 0, size = 0;
    for (int i = 0; i < 42; ++i)
      for (int k = 0; k < 3; ++k) {
        const std::size_t j =
            dcm::node_address(w.state.dcm, 0, i) + static_cast<Address>(k * kLanes);
        residual = std::max(residual,
                            std::abs(at.system.force[j] + at.system.external_force[j] - drag[j]));
        size = std::max(size, std::abs(first_force[j]));
      }
    std::printf("Newton, step %.2g s: residual %.2e nN of first forces of %.2e nN\n", step,
                residual, size);
    // Newton leaves away a last correction below 1e-8 um; the matrix has six edges' friction of
    // 0.1 nN s/um per node over the step, and K_V A^2 / V per node of about 30 nN/um.
    EXPECT_LT(residual, 1e-8 * (0.6 / step + 30));
    EXPECT_LT(residual, 1e-5 * size);
  }
}

TEST(Newton, OneVeryLongStepEndsWhereManyStepsEnd) {
  const auto many = relaxed(Integrator::kLinearlyImplicit, 0.5, 200);
  const auto start = nodes_of(stretched_cell(Integrator::kNewton, 1));
  const double moved = largest_edge_difference(start, many);
  EXPECT_GT(moved, 0.3);
  double last = moved;
  for (const double step : {1e2, 1e3, 1e4}) {
    const auto one = relaxed(Integrator::kNewton, step, step);
    const double apart = largest_edge_difference(one, many);
    std::printf("Newton, one step of %.0e s: edges %.2e um from rest, of %.2g um\n", step, apart,
                moved);
    // Backward Euler leaves 1 / (1 + step / tau) of a mode that relaxes with tau < 2 s.
    EXPECT_LT(apart, 2 / step * moved);
    EXPECT_LT(apart, 0.11 * last);
    last = apart;
  }
}

// The matrix holds friction and stiffness together; its friction is computed separately.
TEST(Friction, OfTheMatrixIsThatOfOneWithoutStiffness) {
  for (const double across : {1.0, 0.3, 0.0}) {
    World w = make_test_world(checkered_cube(23.5), 60, 42);
    for (dcm::Params& p : w.params.dcm) p.friction_across = across;
    contact::Capsule shell;
    shell.center = Vec3::Constant(11.75);
    shell.radius = 32;
    w.params.boundary.capsules = {shell};
    SizedWorkspace work(w);
    ASSERT_TRUE(take_step(w, work, 60).accepted);
    const auto& x = w.state.last_move;
    std::vector<double> wanted(x.size()), found(x.size()), external(x.size()), outside(x.size());
    assemble(w, 60, work, {.stiffness = false});
    work.op.apply(x, wanted);
    work.op.apply_external(x, external);
    assemble(w, 60, work);
    work.op.apply_friction(x, found);
    work.op.apply_external_friction(x, outside);
    double largest = 0, off = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      largest = std::max(largest, std::abs(wanted[k]));
      off = std::max({off, std::abs(found[k] - wanted[k]), std::abs(outside[k] - external[k])});
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(off, 1e-6 * largest) << "rounding of springs to float";
  }
}

}  // namespace
}  // namespace acinus::coupling
