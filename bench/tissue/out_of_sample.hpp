#pragma once
/// Validity of a sphere stiffness law in tissue it was not calibrated in.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Benchmark of laws out of sample, one row per scene and law. "In place": spheres at the positions
/// of the deformable cells in every frame, which tests the law alone, also laws without an
/// implementation in runs; frames with newborn cells are excluded. "By themselves": the scene run
/// with spheres, plain and with the tabulated law, from options.seeds seeds: means and standard
/// deviations; in place the first seed only. The law is that of the scene calibration.json
/// for cells of 12 um, whatever radius and stiffness the scenes have. Errors are rms over frames
/// (of cell means) or over cells and frames, relative to the rms of the deformable cells, and in
/// Pa: in loose tissue the mean pressure is near zero and its relative error means little. Runs are
/// kept in the folder "out-of-sample" of options.folder and not repeated.
BenchTable bench_out_of_sample(const BenchOptions& options);

}  // namespace acinus::bench
