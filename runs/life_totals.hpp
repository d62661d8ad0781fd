#pragma once
/// What growth and division added up to in a run and its resumes.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/io/checkpoint.hpp"
#include "coupling/life/life.hpp"

namespace acinus::runs {

struct LifeTotals {
  double start_cells = 0;
  /// Wall time, s, when there were first 10, 100, .. 10^6 cells; 0: not yet.
  std::array<double, 6> wall_s_at{};
  // Largest of all divisions of deformable cells (coupling::DivisionFigures):
  double volume_error = 0, outside_um = 0, settled_shift_um = 0, pressure_change_kPa = 0,
         settled_pressure_change_kPa = 0;
  double planes = 0;       ///< most tried in one division
  double steps = 0;        ///< of all sub-simulations
  double waits = 0;        ///< divisions put off for want of a clean plane
  double min_quality = 1;  ///< of a daughter's mesh
  double remeshed = 0;     ///< cells that got a better mesh
  double degenerate = 0;   ///< looks at which a cell's mesh could not be mended
};

/// @param wall_s  since the start of the run
void add_life(LifeTotals& totals, const coupling::LifeReport& report, int n_cell, double wall_s);

void put_totals(const LifeTotals& totals, io::CheckpointData& data);
LifeTotals get_totals(const io::CheckpointData& data);

/// Number of cells and wall time of each step to it that was reached.
std::vector<std::pair<std::string, double>> wall_times(const LifeTotals& totals);

}  // namespace acinus::runs
