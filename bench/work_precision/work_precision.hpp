#pragma once
/// Work-precision benchmarks of all numerical settings (docs/developers/work_precision.md):
/// Markdown tables, SVG plots, and the cheapest setting for a given error.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

BenchTable bench_work_precision(const BenchOptions& options);  ///< all of those below
BenchTable bench_stretch(const BenchOptions& options);         ///< one stretched cell
BenchTable bench_clump(const BenchOptions& options);           ///< 13 growing cells, and 27
BenchTable bench_capsule(const BenchOptions& options);         ///< 27 compressed cells
BenchTable bench_growth(const BenchOptions& options);          ///< growing spheroids
BenchTable bench_cbm(const BenchOptions& options);             ///< 1000 spheres

}  // namespace acinus::bench
