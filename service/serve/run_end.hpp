#pragma once
/// Outcome of a run of the service, from the files in its folder.

#include <filesystem>
#include <optional>
#include <string>

#include "runs/session/read_summary.hpp"

namespace acinus::service {

using FileTime = std::filesystem::file_time_type;

/// Path of the file that receives the output of a run.
std::string output_file(const std::string& folder);

/// Messages that a run printed on stderr, without warnings and the program's name.
std::string printed_messages(const std::string& folder);

/// Summary of a run folder; empty if it is missing, incomplete or older than `since`.
std::optional<runs::RunSummary> find_summary(const std::string& folder, FileTime since);

/// Cause of a stop that no client requested.
std::string find_stop_cause(const std::string& folder, FileTime since);

}  // namespace acinus::service
