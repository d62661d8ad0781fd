#pragma once
/// The scenes of the work-precision benchmark and the settings compared on each.

#include <vector>

#include "bench/work_precision/work_precision_run.hpp"

namespace acinus::bench {

/// A scene with its studies. Those of `time` have a reference on the same mesh and a converged
/// step, those of `space` one on a finer mesh.
struct WorkCase {
  WorkScene scene;
  std::vector<PrecisionStudy> time, space;
};

/// One cell in a liquid, stretched at constant volume and let go.
WorkCase stretch_case();
/// Thirteen packed deformable cells that double their volume in a day. The last study of `time`
/// covers a short window, for explicit Euler.
WorkCase clump_case();
/// 27 cells of the same kind: the usual step against a short one.
WorkCase packed_case();
/// A spheroid of deformable cells that grows and divides, from about so many cells on.
WorkCase growth_case(int cells);
/// 27 deformable cells in a shrinking rigid sphere.
WorkCase capsule_case();
/// 1000 spheres with random motility; the random forces are fixed on a grid in time.
WorkCase cbm_case();

}  // namespace acinus::bench
