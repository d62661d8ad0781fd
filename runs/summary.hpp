#pragma once
/// summary.json: the numbers of a run that scripts rely on.

#include <string>
#include <vector>

#include "core/timing.hpp"
#include "coupling/audit.hpp"
#include "coupling/world.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/life_totals.hpp"
#include "runs/run.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Figures that accumulate over a run and its resumes.
struct RunTotals {
  double wall_s = 0, cpu_s = 0;
  double max_penetration_um = 0, max_penetration_grown_um = 0;
  double dcm_dcm_um = 0, dcm_vessel_um = 0, dcm_wall_um = 0, dcm_cbm_um = 0;
  double cbm_vessel_um = 0, cbm_wall_um = 0;
  double dcm_cbm_beyond_um = 0;  ///< deeper than the dent that the pair's force explains
  double max_overlap_cbm_um = 0;
  double min_triangle_quality = 1;
  double self_intersecting = 0, inverted = 0;  ///< cells in any audited frame
  double frames = 0, series = 0, events = 0;   ///< written to the run file
};
void add_audit(RunTotals& totals, const coupling::AuditResult& audit);

struct SummaryInput {
  const Scene& scene;
  const RunOptions& options;
  const coupling::World& world;
  const RunTotals& totals;
  const LifeTotals& life;
  const Measures& measures;
  const Timings& timings;
  const std::vector<std::string>& skipped;
  const std::vector<std::string>& notes;
  std::string status;  ///< completed | stopped | failed
  std::string cause;   ///< why it stopped or failed
  int threads = 1;
};

/// Writes folder/summary.json in place of an older one, whole or not at all.
/// @throws Error(kFileError)
void write_summary(const std::string& folder, const SummaryInput& input);

}  // namespace acinus::runs
