#pragma once
/// The folder of a study: whether it may be used.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Refuses a folder with another study or something else in it.
/// @throws Error(kBadInput)
void check_study_folder(const std::string& root, const StudyPlan& plan);

/// Makes the folder and writes into it whose it is.   @throws Error(kFileError)
void make_study_folder(const std::string& root, const StudyPlan& plan);

}  // namespace acinus::runs
