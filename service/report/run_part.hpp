#pragma once
/// Run as JSON for the report page.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/report/frames.hpp"
#include "service/report/run_record.hpp"

namespace acinus::service {

/// Most samples of a curve; longer curves are thinned (thin.hpp).
inline constexpr int kMostSamples = 800;

/// Describes a run: status, facts, scene, walls, results, checks, times of stages, curves and
/// frames.
/// @param run  read faults of its frames are added to its damage
nlohmann::ordered_json describe_run(RunRecord& run, const FrameLimits& limits);

/// Frames as the 3D view of the page reads them.
/// @param in_file  number of frames of the run file
nlohmann::ordered_json describe_frames(const PackedRun& packed, int in_file);

/// Number rounded to six significant digits; null if it is not finite.
nlohmann::ordered_json short_number(double value);

}  // namespace acinus::service
