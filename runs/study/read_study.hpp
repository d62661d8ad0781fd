#pragma once
/// Reader of study files: from a file to a plan with resolved scenes and checked names.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Reads a study file.
/// @param path  file, or name of a shipped study
/// @throws Error listing all faults of the study and its scenes, one a line with line and column;
/// kFileError for an unreadable file
StudyPlan read_study(const std::string& path);

/// Reads a study from a text.
/// @param label   stands for the file name in messages; its stem is the default name
/// @param folder  base of relative file names
/// @throws Error as read_study()
StudyPlan parse_study(const std::string& text, const std::string& label,
                      const std::string& folder = ".");

}  // namespace acinus::runs
