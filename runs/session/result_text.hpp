#pragma once
/// Result of a run in words, for the terminal.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Number of cells by model: "13 deformable cells, 1 sphere".
std::string describe_cells(int deformable, int spheres);

/// Cells at the end, and the deepest overlap of each model with a verdict.
/// Overlaps of spheres that falsify loads get a line more.
/// @param start_cells  number of cells at t = 0
std::vector<std::string> describe_result(const coupling::World& world, const RunTotals& totals,
                                         int start_cells);

/// Commands and programs that show a run folder.
std::string advise_viewing(const std::string& folder);

}  // namespace acinus::runs
