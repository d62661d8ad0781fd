#pragma once
/// End of a run of the service, from the files in its folder.

#include <filesystem>
#include <optional>
#include <string>

#include "runs/session/read_summary.hpp"

namespace acinus::runs {

using FileTime = std::filesystem::file_time_type;

/// File that gets what a run prints.
std::string output_file(const std::string& folder);

/// All that a run printed on stderr but warnings, without the program's name.
std::string told(const std::string& folder);

/// Summary of a run folder; nothing if there is none, it is torn, or older than `since`.
std::optional<RunSummary> find_summary(const std::string& folder, FileTime since);

/// Cause of a stop that no client asked for.
std::string why_stopped(const std::string& folder, FileTime since);

}  // namespace acinus::runs
