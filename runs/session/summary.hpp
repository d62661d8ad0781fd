#pragma once
/// summary.json: the figures of a run that scripts rely on.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/scene/scene.hpp"
#include "runs/session/attempts.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_outcome.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Sources of the figures of a summary.
struct SummaryInput {
  const Scene& scene;
  const RunOptions& options;
  const coupling::World& world;
  const RunTotals& totals;
  const LifeTotals& life;
  const Measures& measures;
  Attempts attempts;       ///< with this one
  const Timings& timings;  ///< of this attempt
  const std::vector<std::string>& skipped;
  const Notes& notes;
  RunOutcome status;
  std::string cause;         ///< cause of a stop or failure
  std::uint64_t state_hash;  ///< of coupling::hash_state(), at the end
  double largest_sphere_um;  ///< radius of the largest sphere at the end; 0 without spheres
  int threads = 1;
};

/// Writes folder/summary.json, atomically replacing an older one.
/// @throws Error(kFileError)
void write_summary(const std::string& folder, const SummaryInput& input);

}  // namespace acinus::runs
