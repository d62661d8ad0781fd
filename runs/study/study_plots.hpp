#pragma once
/// The plots of a study.

#include <string>
#include <vector>

#include "io/plot.hpp"
#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// A plot of the study file: one line per variant with the mean over the seeds that have a value,
/// and the band between their smallest and largest; its reference points.
io::Plot make_plot(const StudyPlan& plan, const StudyData& data, const StudyPlot& wanted);

/// Writes plots/<name>.svg for every plot and figure of the file; one of each observable of the
/// table if the file asks for no plot.   @return file names in plots/, in that order
/// @throws Error(kFileError)
std::vector<std::string> write_plots(const StudyPlan& plan, const StudyData& data,
                                     const std::string& root);

}  // namespace acinus::runs
