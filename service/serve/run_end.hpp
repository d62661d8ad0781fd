#pragma once
/// Outcome of a run of the service, from the files in its folder.

#include <filesystem>
#include <optional>
#include <string>

#include "runs/session/read_summary.hpp"

namespace acinus::runs {

using FileTime = std::filesystem::file_time_type;

/// Path of the file that receives the output of a run.
std::string output_file(const std::string& folder);

/// Messages that a run printed on stderr, without warnings and the program's name.
std::string told(const std::string& folder);

/// Summary of a run folder; empty if it is missing, incomplete or older than `since`.
std::optional<RunSummary> find_summary(const std::string& folder, FileTime since);

/// Cause of a stop that no client requested.
std::string why_stopped(const std::string& folder, FileTime since);

}  // namespace acinus::runs
