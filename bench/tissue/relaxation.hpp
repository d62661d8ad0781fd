#pragma once
/// How a compressed clump comes back: protocols, forms of friction, meshes and models side by side.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// The shipped relaxation_capsule and relaxation_plates, held for 1 h and for 10 h: deformable
/// cells with both forms of friction and with 162 and 642 nodes, plain and calibrated spheres. Of
/// the overlap (capsule) or the height (plates): how much of the compression is left after some
/// times, and the way back as the experiment "relaxation" measures it. Runs stand in the folder
/// "relaxation" of options.folder and are not made again.
BenchTable bench_relaxation(const BenchOptions& options);

}  // namespace acinus::bench
