#pragma once
/// Closing of a central lesion: its size by several readings, births, speeds, plates.

#include <optional>
#include <string>
#include <vector>

#include "runs/experiments/observed_frame.hpp"
#include "runs/experiments/observed_run.hpp"

namespace acinus::runs {

/// Adds one number to each series of the experiment "lobule". Areas are relative to the first frame
/// the run observed.   @pre sample_experiment
void sample_lobule(const ObservedFrame& frame, ObservedRun& observed);

/// "1" to "6" and "beyond": the endings of series by layer.
std::vector<std::string> layer_names();

/// The series by which a lesion counts as closed, the one of `closed_d` first.
std::vector<std::string> closing_areas();

/// Days until a relative area is first below 0.05, between frames by the straight line; nothing if
/// it never is.
/// @param time_d  of the values
std::optional<double> closing_time(const std::vector<double>& time_d,
                                   const std::vector<double>& area);

}  // namespace acinus::runs
