#pragma once
/// Recovery of a compressed clump for several protocols, forms of friction, meshes and models.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Benchmark: shipped scenes relaxation_capsule and relaxation_plates, held for 1 h and 10 h:
/// deformable cells with both forms of friction and with 162 and 642 nodes, plain and calibrated
/// spheres. Figures: remaining compression of overlap (capsule) or height (plates) after several
/// times, and the recovery as measured by the experiment "relaxation". Runs are kept in the folder
/// "relaxation" of options.folder and not repeated.
BenchTable bench_relaxation(const BenchOptions& options);

}  // namespace acinus::bench
