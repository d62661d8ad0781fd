#pragma once
/// Heat maps of a study.

#include <string>
#include <vector>

#include "io/heat_map.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// Heat map with one field per variant: number of seeds within the bounds and mean (median if the
/// measure is infinite for some). Fields without a variant or with incomplete runs are unknown.
io::HeatMap make_map(const StudyPlan& plan, const StudyData& data, const StudyMap& wanted);

/// Writes plots/<name>.svg for every map of the study.
/// @return file names in plots/, in the order of the file
/// @throws Error(kFileError)
std::vector<std::string> write_maps(const StudyPlan& plan, const StudyData& data,
                                    const std::string& root);

}  // namespace acinus::runs
