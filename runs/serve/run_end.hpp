#pragma once
/// How a run of the service ended, from what it left in its folder.

#include <filesystem>
#include <optional>
#include <string>

#include "runs/session/read_summary.hpp"

namespace acinus::runs {

using FileTime = std::filesystem::file_time_type;

/// File that gets what a run prints.
std::string output_file(const std::string& folder);

/// What a run that could not even begin has told, without the program's name.
std::string told(const std::string& folder);

/// The summary of a run folder; nothing if there is none, it is torn, or older than that.
std::optional<RunSummary> find_summary(const std::string& folder, FileTime since);

/// Why a run stopped by itself.
std::string why_stopped(const std::string& folder, FileTime since);

}  // namespace acinus::runs
