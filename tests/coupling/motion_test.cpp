/// Single cells moving: drag, diffusion, time order.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "coupling/migration/migration.hpp"
#include "coupling/step/step.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

Vec3 center(const World& w, bool deformable) {
  return deformable ? dcm::cell_center(w.state.dcm, 0) : cbm::center_of(w.state.cbm, 0);
}

TEST(Motion, LoneCellMovesAtForceOverDrag) {
  for (bool deformable : {true, false})
    for (double viscosity : {0.0, 1e-6}) {
      const Vec3 pull = viscosity > 0 ? Vec3(2e-6, 1e-6, 0) : Vec3(0.3, 0.1, -0.2);
      World w = make_test_world({{Vec3(1, 2, 3), deformable, pull}});
      w.params.dcm[0].viscosity = w.params.cbm[0].viscosity = viscosity;
      w.params.numerics.cg.tolerance = 1e-10;
      SizedWorkspace work(w);
      const Vec3 start = center(w, deformable);
      ASSERT_TRUE(run_until(w, work, 3600));
      const double surface =
          deformable ? geometry::shared_icosphere(162).rest_area * 144 : 4 * kPi * 144;
      const double drag =
          viscosity > 0 ? dcm::stokes_drag(viscosity, 12) : (deformable ? 0.1 : 0.5) * surface;
      const Vec3 expected = 3600 / drag * pull;
      const double error = (center(w, deformable) - start - expected).norm() / expected.norm();
      std::printf("%s drag, %s: relative error %.2g\n", deformable ? "DCM" : "CBM",
                  viscosity > 0 ? "liquid" : "matrix", error);
      EXPECT_LT(error, 1e-6);
    }
}

/// Mean square displacement of one cell over many increments, relative to 6 D t.
/// @param reject_every  so often a step is attempted, rejected, and made in two halves; 0: never
double spread(bool deformable, double step, int reject_every, int n) {
  World w = make_test_world({{Vec3::Zero(), deformable}}, step, 42);
  w.params.motility.random = true;
  w.params.numerics.cg.tolerance = 1e-8;
  SizedWorkspace work(w);
  double sum = 0;
  Vec3 last = center(w, deformable);
  for (int k = 1; k <= n; ++k) {
    if (reject_every > 0 && k % reject_every == 0) {
      Effort effort;
      if (!attempt_step(w, step, true, work, effort).accepted) return -1;
      if (!run_until(w, work, 60.0 * k - step / 2)) return -1;
    }
    if (!run_until(w, work, 60.0 * k)) return -1;
    const Vec3 now = center(w, deformable);
    sum += (now - last).squaredNorm();
    last = now;
  }
  return sum / (n * 6 * 1e-4 * 60);
}

TEST(Motion, RandomMotilityDiffusesAsSixDt) {
  // 4000 increments of three components: standard deviation sqrt(2 / 12000) = 1.3 %
  for (bool deformable : {true, false}) {
    const double plain = spread(deformable, 60, 0, 4000);
    std::printf("%s <r^2>/(6 D t) = %.4f\n", deformable ? "DCM" : "CBM", plain);
    EXPECT_NEAR(plain, 1, 0.05);
  }
}

TEST(Motion, RejectedStepsLeaveNoTraceInTheNoise) {
  for (bool deformable : {true, false}) {
    const double plain = spread(deformable, 60, 0, 300), broken = spread(deformable, 60, 3, 300);
    std::printf("%s with and without rejections: %.6f %.6f\n", deformable ? "DCM" : "CBM", plain,
                broken);
    EXPECT_NEAR(broken, plain, 1e-5);
  }
}

TEST(Motion, StepsLongerThanTheNoiseGridKeepTheImpulse) {
  const World w = make_test_world({{Vec3::Zero()}});
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 10; ++k) sum += 60 * mean_random(7, 3, 60, 60.0 * k, 60);
  EXPECT_LT((600 * mean_random(7, 3, 60, 0, 600) - sum).norm(), 1e-9);
  Vec3 pieces = Vec3::Zero();
  for (int k = 0; k < 24; ++k) pieces += 25 * mean_random(7, 3, 60, 25.0 * k, 25);
  EXPECT_LT((pieces - sum).norm(), 1e-9);
}

TEST(Motion, TimeOrderIsOne) {
  // Two cells drawn into contact from just touching; successive halvings.
  auto end = [](double step) {
    World w = make_test_world({{Vec3(-12.15, 0, 0)}, {Vec3(12.15, 0, 0)}}, step);
    w.params.numerics.cg = {1e-10, 20000};
    SizedWorkspace work(w);
    EXPECT_TRUE(run_until(w, work, 960));
    return gather_positions(w.state);
  };
  const std::vector<double> a = end(7.5), b = end(3.75), c = end(1.875), d = end(0.9375);
  auto distance = [](const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
    return std::sqrt(sum);
  };
  const double coarse = std::log2(distance(a, b) / distance(b, c)),
               fine = std::log2(distance(b, c) / distance(c, d));
  std::printf("time order by halvings from 7.5 s: %.3f, from 3.75 s: %.3f\n", coarse, fine);
  EXPECT_GT(fine, 0.9);
  EXPECT_LT(fine, 1.1);
}

}  // namespace
}  // namespace acinus::coupling
