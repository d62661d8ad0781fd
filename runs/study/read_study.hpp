#pragma once
/// From a study file to a plan: every scene resolved, everything that is named known.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Reads a study file, a shipped study's name among them.
/// @throws Error: all faults of the study and of the scenes it makes, one a line with line and
///         column; kFileError if a file cannot be read
StudyPlan read_study(const std::string& path);

/// The same for a text in memory.
/// @param label   stands for the file name in messages; its stem is the default name
/// @param folder  where relative file names start
StudyPlan parse_study(const std::string& text, const std::string& label,
                      const std::string& folder = ".");

}  // namespace acinus::runs
