#pragma once
/// Cost of the parts of a step: internal forces and stiffness, contacts, products.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

BenchTable bench_assembly(const BenchOptions& options);  ///< 27, 64 and 512 packed deformable cells
BenchTable bench_jkr(const BenchOptions& options);       ///< sphere contacts per second

}  // namespace acinus::bench
