#pragma once
/// Patch test of the model interface: a compressed ball of deformable cells and spheres against one
/// of deformable cells alone.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Benchmark: shipped scene patch_capsule with shifted zoom regions and with plain spheres. Figures
/// are means over all frames with a mean pressure of the deformable ball from 5 Pa to 250 Pa. Runs
/// are kept in the folder "patch" of options.folder and not repeated.
BenchTable bench_patch(const BenchOptions& options);

}  // namespace acinus::bench
