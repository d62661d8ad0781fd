/// Relaxation times: the fit of a decay, and the exact scaling of times with friction.

#include "calibration/relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/mesh/topology.hpp"
#include "coupling/step.hpp"

namespace acinus::calibration {
namespace {

TEST(Decay, IsFoundWhateverTheSpacingOfSamples) {
  for (const bool even : {true, false}) {
    std::vector<double> t, y;
    for (int k = 0; k <= 100; ++k) {
      t.push_back(even ? 60.0 * k : std::expm1(0.09 * k));
      y.push_back(0.05 + 0.12 * std::exp(-t.back() / 700));
    }
    const Decay d = fit_decay(t, y);
    EXPECT_NEAR(d.time, 700, 0.1);
    EXPECT_NEAR(d.start, 0.17, 1e-5);
    EXPECT_NEAR(d.end, 0.05, 1e-5);
    EXPECT_LT(d.rms, 1e-6);
  }
}

/// Two deformable cells pushed into each other by 2 um.
coupling::World pressed_pair() {
  coupling::World w;
  dcm::Params p;
  p.spring_stiffness = dcm::cortex_spring_stiffness(1, 0.5);
  p.bending_stiffness = dcm::cortex_bending_stiffness(1, 0.5, 0.5);
  p.area_modulus = 0.8;
  p.bulk_modulus = 2.5;
  p.nodal_friction = 0.1;
  p.medium_friction = 0.1;
  p.adhesion = 0.01;
  w.params.dcm = {p};
  w.params.dcm_contact.cell_friction = 50;
  w.params.numerics.tolerance = 0.05;
  w.params.numerics.cg.tolerance = 1e-8;
  std::vector<dcm::NewCell> cells;
  for (int k = 0; k < 2; ++k)
    cells.push_back({k, 0, &mesh::shared_icosphere(42), Vec3(22.0 * k, 0, 0), 12.0, Vec3::Zero(),
                     Mat3(Mat3::Identity())});
  w.state.dcm = dcm::make_state(cells);
  w.state.next_lineage = 2;
  return w;
}

TEST(Relaxation, FiveTimesTheFrictionTakesFiveTimesAsLong) {
  const coupling::World world = pressed_pair();
  coupling::World slow = world;
  scale_all_friction(slow.params, 5);
  const Relaxation fast = relax_clump(world, 1), five = relax_clump(slow, 5);
  // How long each is followed depends on the last digits of a slow tail: the same part is compared.
  const std::size_t n = std::min(fast.time.size(), five.time.size());
  const double way = std::abs(fast.overlap[n - 1] - fast.overlap[0]);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(five.time[k], 5 * fast.time[k], 1e-6 * five.time[k]);
    EXPECT_NEAR(five.overlap[k], fast.overlap[k], 0.01 * way) << fast.time[k];
  }
  const Decay one = fit_decay(std::span(fast.time).first(n), std::span(fast.overlap).first(n)),
              slower = fit_decay(std::span(five.time).first(n), std::span(five.overlap).first(n));
  EXPECT_GT(one.time, 1);
  EXPECT_NEAR(slower.time / one.time, 5, 0.05);
}

}  // namespace
}  // namespace acinus::calibration
