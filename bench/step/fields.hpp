#pragma once
/// Cost of one step of the fields of substances.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// A million voxels with a tissue of 10,000 spheres in them: a morphogen, oxygen with linear and
/// with Michaelis-Menten uptake, also in a closed box, substances that are kept out of cells or
/// pass their membranes, over a step of 60 s.
BenchTable bench_fields(const BenchOptions& options);

}  // namespace acinus::bench
