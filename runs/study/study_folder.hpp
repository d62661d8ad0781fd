#pragma once
/// Folder of a study.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Refuses a folder that holds another study or something else.
/// @throws Error(kBadInput)
void check_study_folder(const std::string& root, const StudyPlan& plan);

/// Creates the folder with the file that names its study.
/// @throws Error(kFileError)
void make_study_folder(const std::string& root, const StudyPlan& plan);

}  // namespace acinus::runs
