#pragma once
/// Whole error of the named accuracies.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Benchmark: tissues at every named accuracy against meshes of 1442 nodes with short steps. Growth
/// and compression are those that the accuracies were chosen by, a monolayer and a clump between
/// plates were not used for that. Figures, of means over the cells of the last fifth of the frames
/// and over options.seeds seeds: error of the whole, and its part from time step and solver (the
/// rest is that of the mesh and its contact points), both relative and signed; CPU time of a run.
/// Runs are kept in the folder "accuracy" of options.folder and not repeated.
BenchTable bench_accuracy(const BenchOptions& options);

}  // namespace acinus::bench
