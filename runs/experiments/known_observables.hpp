#pragma once
/// What can be asked of the runs of an experiment.

#include <map>
#include <string>

namespace acinus::runs {

/// Names and units ("1" = dimensionless) of what a run of this experiment may write, one value per
/// written frame: the measures of the experiment, named without their unit, and the columns of
/// /series.
std::map<std::string, std::string> known_observables(const std::string& experiment);

}  // namespace acinus::runs
