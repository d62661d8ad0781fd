#pragma once
/// Heat maps of a study.

#include <string>
#include <vector>

#include "io/heat_map.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// A map of the study file: one field per variant, with the seeds that are within the bounds and
/// the mean (median where some never get there). Fields without a variant, or whose runs are not
/// done, are unknown.
io::HeatMap make_map(const StudyPlan& plan, const StudyData& data, const StudyMap& wanted);

/// Writes plots/<name>.svg for every map of the file.   @return file names in plots/, in that order
/// @throws Error(kFileError)
std::vector<std::string> write_maps(const StudyPlan& plan, const StudyData& data,
                                    const std::string& root);

}  // namespace acinus::runs
