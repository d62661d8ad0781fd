/// Thirteen adhering cells for six hours with steps from 7.5 s to 10 min, controller and cap off:
/// every step size must survive, and the error must fall with the step.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "core/numbers/random.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/measure/audit.hpp"
#include "coupling/measure/difference.hpp"
#include "coupling/measure/measure.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

struct Outcome {
  bool completed = false;
  std::vector<Vec3> center;
  std::vector<double> pressure, volume;
  double penetration = 0;  ///< um, largest in any hourly audit
};

Outcome run(double step) {
  UniformStream random(1, Purpose::kJitter, 0);
  std::vector<TestCell> cells;
  for (const Vec3& x :
       make_clump({Lattice::kFcc, 13, 1.015 * 24, 0.01 * 24}, [&] { return random.uniform(); }))
    cells.push_back({x});
  World w = make_test_world(cells, step);
  w.params.numerics.cg.tolerance = 1e-4;
  SizedWorkspace work(w);
  Outcome out;
  for (int hour = 1; hour <= 6; ++hour) {
    if (!run_until(w, work, 3600.0 * hour)) return out;
    observe(w, work);
    std::vector<AuditMesh> meshes;
    for (std::size_t b = 0; b < work.dcm.body.size(); ++b)
      meshes.push_back(
          {static_cast<std::int64_t>(b), work.dcm.body[b].node, *work.dcm.body[b].triangle});
    AuditFrame frame;
    frame.meshes = meshes;
    out.penetration = std::max(out.penetration, audit(frame).max_penetration_um);
  }
  for (const CellMeasure& m : measure_cells(w, work)) {
    out.center.push_back(m.center);
    out.pressure.push_back(m.cytosol_pressure);
    out.volume.push_back(m.volume);
  }
  out.completed = true;
  return out;
}

TEST(ClumpSlow, EveryStepSizeSurvivesAndErrorsFall) {
  const Outcome reference = run(7.5);
  ASSERT_TRUE(reference.completed);
  std::array<double, 3> error{};
  int k = 0;
  for (double step : {60.0, 120.0, 600.0}) {
    const Outcome o = run(step);
    ASSERT_TRUE(o.completed) << "dt = " << step;
    error[k] = relative_error(o.pressure, reference.pressure);
    std::printf(
        "dt %5.0f s against 7.5 s: pressure %.3g %%, volume %.3g %%, centres (aligned) %.3g um; "
        "penetration %.3f um\n",
        step, 100 * error[k], 100 * relative_error(o.volume, reference.volume),
        aligned_distance(o.center, reference.center).max, o.penetration);
    if (step == 60) {
      EXPECT_LT(o.penetration, 0.3);
    }
    ++k;
  }
  EXPECT_LT(error[0], error[2]);
}

}  // namespace
}  // namespace acinus::coupling
