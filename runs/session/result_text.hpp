#pragma once
/// Result of a run in words, for the terminal.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Time or wall time in a unit that suits it: "45 s", "12.5 min", "20.0 h".
std::string format_duration(double seconds);

/// Number of cells by model: "13 deformable cells, 1 sphere".
std::string describe_cells(int deformable, int spheres);

/// Mean pressures of both models in the last frame: "pressure of deformable cells at the end: 5.2
/// Pa in the cytosol, 0.1 Pa at contacts". Empty without frames.
std::vector<std::string> describe_pressures(const Measures& measures);

/// Cells at the end, and the deepest overlap of each model with a verdict.
/// Overlaps of spheres that falsify loads get a line of advice. Collective.
/// @param start_cells  number of cells at t = 0
std::vector<std::string> describe_result(const coupling::World& world, const RunTotals& totals,
                                         int start_cells);

/// Place of a stopped run: "at 1.5 h of 2.0 h", or the time spent in start-up.
/// @param end  planned end, s since t = 0
std::string describe_progress(const coupling::World& world, double end);

/// Commands and programs that show a run folder, a line each.
std::vector<std::string> advise_viewing(const std::string& folder);

}  // namespace acinus::runs
