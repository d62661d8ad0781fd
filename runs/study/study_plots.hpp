#pragma once
/// Plots of a study.

#include <string>
#include <vector>

#include "io/plot.hpp"
#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// Plot of the study file: one line per variant with mean and range over the seeds that have a
/// value, and its reference data.
io::Plot make_plot(const StudyPlan& plan, const StudyData& data, const StudyPlot& wanted);

/// Writes plots/<name>.svg for every plot and figure of the study, or one for every observable of
/// the table if there are none.
/// @return file names in plots/, in that order
/// @throws Error(kFileError)
std::vector<std::string> write_plots(const StudyPlan& plan, const StudyData& data,
                                     const std::string& root);

}  // namespace acinus::runs
