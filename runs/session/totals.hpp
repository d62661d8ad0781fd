#pragma once
/// Totals over a run and its resumptions, kept in checkpoints by name.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "coupling/life/life.hpp"
#include "coupling/measure/audit.hpp"
#include "io/checkpoint.hpp"

namespace acinus::runs {

/// Cost of the run, and the worst figures of all audited frames.
struct RunTotals {
  double wall_s = 0, cpu_s = 0;
  double max_penetration_um = 0, max_penetration_grown_um = 0;
  double dcm_dcm_um = 0, dcm_vessel_um = 0, dcm_wall_um = 0, dcm_cbm_um = 0;
  double cbm_vessel_um = 0, cbm_wall_um = 0;
  double dcm_cbm_beyond_um = 0;  ///< overlap beyond the indentation that the pair's force explains
  double max_overlap_cbm_um = 0;
  double min_triangle_quality = 1;
  double self_intersecting = 0, inverted = 0;  ///< most cells in any audited frame
};

/// Totals of growth and division.
struct LifeTotals {
  double start_cells = 0;
  /// Wall time at which the run first had 10, 100, .. 10^6 cells, s; 0: not reached.
  std::array<double, 6> wall_s_at{};
  // Largest of all divisions of deformable cells (coupling::DivisionFigures):
  double volume_error = 0, outside_um = 0, settled_shift_um = 0;
  double pressure_change = 0, settled_pressure_change = 0;  ///< kPa
  double planes = 0;                                        ///< most planes tried in one division
  double steps = 0;                                         ///< of all sub-simulations
  double waits = 0;        ///< divisions postponed for want of a clean plane
  double min_quality = 1;  ///< least mesh quality of a daughter
  double remeshed = 0;     ///< remeshed cells
  double degenerate = 0;   ///< failed remeshings
};

/// Takes over the worst figures of the audit of a frame.
void add_audit(RunTotals& totals, const coupling::AuditResult& audit);

/// Adds the events and divisions of a step.
/// @param n_cell  number of cells after them
/// @param wall_s  wall time since the start of the run, s
void add_life(LifeTotals& totals, const coupling::LifeReport& report, int n_cell, double wall_s);

/// Writes the totals to a checkpoint.
void put_totals(const RunTotals& totals, io::CheckpointData& data);
void put_totals(const LifeTotals& totals, io::CheckpointData& data);
/// Reads the totals of a checkpoint.
/// @throws Error(kFileError) if one is missing
void get_totals(const io::CheckpointData& data, RunTotals& totals);
void get_totals(const io::CheckpointData& data, LifeTotals& totals);

/// Pairs of number of cells and wall time (s) for every power of ten reached.
std::vector<std::pair<std::string, double>> wall_times(const LifeTotals& totals);

}  // namespace acinus::runs
