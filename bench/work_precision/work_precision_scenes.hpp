#pragma once
/// Scenes of the work-precision benchmarks with their studies.

#include <vector>

#include "bench/work_precision/work_precision_run.hpp"

namespace acinus::bench {

/// Scene with its studies: `time` against a converged step on the same mesh, `space` against a
/// finer mesh.
struct WorkCase {
  WorkScene scene;
  std::vector<PrecisionStudy> time, space;
};

/// One cell in a liquid, stretched at constant volume and released.
WorkCase stretch_case();
/// Thirteen packed deformable cells that double their volume in a day. The last study of `time`
/// covers a short window, for explicit Euler.
WorkCase clump_case();
/// 27 cells of the same kind: usual step against a short one.
WorkCase packed_case();
/// Growing and dividing spheroid of deformable cells.
/// @param cells  number at the start
WorkCase growth_case(int cells);
/// 27 deformable cells in a shrinking rigid sphere.
WorkCase capsule_case();
/// 1000 spheres with random motility; the random forces are fixed on a time grid.
WorkCase cbm_case();

}  // namespace acinus::bench
