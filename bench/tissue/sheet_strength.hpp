#pragma once
/// Strength of the sheet of contacts in a block of cells under both contact laws.

#include <vector>

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Strength against adhesion energy W, on a grid that rises.
struct StrengthCurve {
  std::vector<double> adhesion, strength;
};

/// Adhesion energy at which a curve has a strength: linear between logarithms, beyond the grid with
/// the slope of its last interval.
/// @pre at least two points, all positive, strengths rise (asserted)
double adhesion_of(const StrengthCurve& curve, double strength);

/// Scene tear, a block of eight cells that is torn in two, with 162 and 642 nodes a cell, both laws
/// and W from 3e-6 to 5e-5 J/m^2. A row for each mesh and W of Maugis-Dugdale: largest force and
/// work under either law, mean over `seeds` blocks that were torn, and the W of the cohesive law
/// that is as strong, over that of Maugis-Dugdale, by force and by work. Runs are kept in the
/// folder "tear" of options.folder and not repeated.
BenchTable bench_sheet_strength(const BenchOptions& options);

}  // namespace acinus::bench
