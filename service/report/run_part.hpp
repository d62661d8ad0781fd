#pragma once
/// One run as the page's script reads it.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/report/frames.hpp"
#include "service/report/run_record.hpp"

namespace acinus::runs {

/// Most samples of a curve; more are thinned (thin.hpp).
inline constexpr int kMostSamples = 800;

/// Status, facts, scene, checks, times of stages, curves and frames of a run.
/// @param run  in: as read; what cannot be read of its frames is added to its damage
nlohmann::ordered_json describe_run(RunRecord& run, const FrameLimits& limits);

/// A number with the digits a plot needs; null where there is none.
nlohmann::ordered_json short_number(double value);

}  // namespace acinus::runs
