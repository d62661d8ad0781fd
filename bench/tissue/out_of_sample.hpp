#pragma once
/// How spheres do with a law of stiffness in tissue that it was not found in.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// A row for every scene and law. "In place": spheres put where the deformable cells are in every
/// frame, which tells about the law alone; laws that no run has yet are judged so, too. "By
/// themselves": the same scene run with spheres, plain and by the table. Frames in which cells were
/// just born are left out of the former. The law is the one that the scene calibration.json gives
/// for cells of 12 um, whatever radius and stiffness the cells of the scenes are given. Errors are
/// rms over frames (means of the cells) or over cells and frames, over the rms of the deformable
/// cells, and in Pa: in tissue that nothing holds together but adhesion the mean pressure is next
/// to nothing, and a relative error of it says little. Runs stand in the folder "out-of-sample" of
/// options.folder and are not made again.
BenchTable bench_out_of_sample(const BenchOptions& options);

}  // namespace acinus::bench
